#include "surface_search.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <limits>

#include "exchange.hpp"

namespace mortise {
namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::d2::point_xy<double>;
using Box = geometry::model::box<Point>;
using Segment = geometry::model::segment<Point>;

Box box_of(const PlacedFacet& facet, double inflation) {
  const auto [x_low, x_high] = std::minmax(facet.x[0][0], facet.x[1][0]);
  const auto [y_low, y_high] = std::minmax(facet.x[0][1], facet.x[1][1]);
  return {{x_low - inflation, y_low - inflation}, {x_high + inflation, y_high + inflation}};
}

Segment segment_of(const PlacedFacet& facet) { return {{facet.x[0][0], facet.x[0][1]}, {facet.x[1][0], facet.x[1][1]}}; }

/// {x low, y low, x high, y high} of every rank; low > high where a rank has no facet.
std::vector<std::array<double, 4>> gather_boxes(const Communicator& comm, const std::vector<PlacedFacet>& facets, const std::vector<double>& radius) {
  constexpr double far = std::numeric_limits<double>::max();
  std::array<double, 4> mine = {far, far, -far, -far};
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Box box = box_of(facets[f], radius[f]);
    mine = {std::min(mine[0], box.min_corner().x()), std::min(mine[1], box.min_corner().y()), std::max(mine[2], box.max_corner().x()),
            std::max(mine[3], box.max_corner().y())};
  }
  std::vector<std::array<double, 4>> boxes(static_cast<std::size_t>(comm.getSize()));
  Teuchos::gatherAll(comm, 4, mine.data(), 4 * comm.getSize(), boxes.front().data());
  return boxes;
}

}  // namespace

double segment_distance(const std::array<Eigen::Vector2d, 2>& a, const std::array<Eigen::Vector2d, 2>& b) {
  return geometry::distance(Segment({a[0].x(), a[0].y()}, {a[1].x(), a[1].y()}), Segment({b[0].x(), b[0].y()}, {b[1].x(), b[1].y()}));
}

std::vector<std::vector<PlacedFacet>> facets_within(const Communicator& comm, const std::vector<PlacedFacet>& slave,
                                                    const std::vector<double>& radius, const std::vector<PlacedFacet>& master) {
  const auto boxes = gather_boxes(comm, slave, radius);
  std::vector<std::vector<PlacedFacet>> send(boxes.size());
  for (const PlacedFacet& facet : master) {
    const Box box = box_of(facet, 0.0);
    for (std::size_t r = 0; r < boxes.size(); ++r) {
      const auto& [x_low, y_low, x_high, y_high] = boxes[r];
      if (x_low > x_high) continue;
      if (geometry::intersects(box, Box({x_low, y_low}, {x_high, y_high}))) send[r].push_back(facet);
    }
  }
  std::vector<PlacedFacet> near;
  for (const auto& part : all_to_all(comm, send)) near.insert(near.end(), part.begin(), part.end());

  std::vector<std::pair<Box, std::size_t>> entries;
  for (std::size_t f = 0; f < near.size(); ++f) entries.emplace_back(box_of(near[f], 0.0), f);
  const geometry::index::rtree<std::pair<Box, std::size_t>, geometry::index::rstar<16>> tree(entries);

  std::vector<std::vector<PlacedFacet>> result(slave.size());
  std::vector<std::pair<Box, std::size_t>> hits;
  for (std::size_t f = 0; f < slave.size(); ++f) {
    hits.clear();
    tree.query(geometry::index::intersects(box_of(slave[f], radius[f])), std::back_inserter(hits));
    for (const auto& hit : hits)
      if (geometry::distance(segment_of(slave[f]), segment_of(near[hit.second])) <= radius[f]) result[f].push_back(near[hit.second]);
    std::sort(result[f].begin(), result[f].end(), [](const PlacedFacet& a, const PlacedFacet& b) { return a.nodes < b.nodes; });
  }
  return result;
}

}  // namespace mortise
