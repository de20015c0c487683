#include "surface_search.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>

#include "exchange.hpp"
#include "mortise/mortar/segment_2d.hpp"

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

// No facet that a line meets is further from its node than the diagonal of the box of all nodes and facets: the line is cut off there.
std::vector<std::optional<double>> distances_along_normals(const Communicator& comm, const std::vector<NormalLine>& lines,
                                                           const std::vector<PlacedFacet>& master) {
  constexpr double on_facet = 1e-9;  // beyond the ends of a facet in its coordinate: no line passes between two facets
  std::array<double, 4> mine, box;   // -x low, -y low, x high, y high
  mine.fill(-std::numeric_limits<double>::max());
  const auto enclose = [&mine](double x, double y) {
    mine = {std::max(mine[0], -x), std::max(mine[1], -y), std::max(mine[2], x), std::max(mine[3], y)};
  };
  for (const NormalLine& line : lines) enclose(line.x.x(), line.x.y());
  for (const PlacedFacet& facet : master)
    for (const auto& x : facet.x) enclose(x[0], x[1]);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 4, mine.data(), box.data());
  const double diagonal = std::hypot(box[0] + box[2], box[1] + box[3]);

  std::vector<PlacedFacet> cut_off;
  for (const NormalLine& line : lines) {
    const Eigen::Vector2d back = line.x - diagonal * line.normal, ahead = line.x + diagonal * line.normal;
    cut_off.push_back({{}, {{{back.x(), back.y()}, {ahead.x(), ahead.y()}}}});
  }
  const auto near = facets_within(comm, cut_off, std::vector<double>(lines.size(), on_facet * diagonal), master);
  std::vector<std::optional<double>> distances(lines.size());
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const Point2<double> x{lines[n].x.x(), lines[n].x.y()}, normal{lines[n].normal.x(), lines[n].normal.y()};
    for (const PlacedFacet& facet : near[n]) {
      const MasterLine<double> line{facet.x};
      if (!faces(line, normal)) continue;
      const auto hit = project_onto(line, x, normal);
      if (std::abs(hit.eta) > 1.0 + on_facet) continue;
      if (!distances[n] || std::abs(hit.distance) < std::abs(*distances[n])) distances[n] = hit.distance;
    }
  }
  return distances;
}

}  // namespace mortise
