#include "search/surface_search.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>

#include "exchange/exchange.hpp"
#include "search/line_distance.hpp"

namespace mortise {
namespace {

namespace geometry = boost::geometry;
using PlanePoint = geometry::model::d2::point_xy<double>;
using Segment = geometry::model::segment<PlanePoint>;

template <int dim>
using BoxPoint = geometry::model::point<double, dim, geometry::cs::cartesian>;
template <int dim>
using Box = geometry::model::box<BoxPoint<dim>>;

template <int dim>
Box<dim> make_box(const std::array<double, dim>& low, const std::array<double, dim>& high) {
  if constexpr (dim == 2)
    return {BoxPoint<2>(low[0], low[1]), BoxPoint<2>(high[0], high[1])};
  else
    return {BoxPoint<3>(low[0], low[1], low[2]), BoxPoint<3>(high[0], high[1], high[2])};
}

template <int dim>
struct Bounds {
  std::array<double, dim> low, high;
  Bounds() {
    low.fill(std::numeric_limits<double>::max());
    high.fill(-std::numeric_limits<double>::max());
  }
  void enclose(const std::array<double, dim>& x, double inflation) {
    for (int i = 0; i < dim; ++i) {
      low[i] = std::min(low[i], x[i] - inflation);
      high[i] = std::max(high[i], x[i] + inflation);
    }
  }
  void enclose(const PlacedFacet<dim>& facet, double inflation) {
    if (non_negative_basis(dim, static_cast<std::size_t>(facet.count)) == nullptr) {
      for (int a = 0; a < facet.count; ++a) enclose(facet.x[a], inflation);
      return;
    }
    for (const auto& point : control_points<dim>(facet.points())) {
      std::array<double, dim> x;
      std::copy(point.begin(), point.end(), x.begin());
      enclose(x, inflation);
    }
  }
  bool empty() const { return low[0] > high[0]; }
  Box<dim> box() const { return make_box<dim>(low, high); }
};

template <int dim>
Box<dim> box_of(const PlacedFacet<dim>& facet, double inflation) {
  Bounds<dim> bounds;
  bounds.enclose(facet, inflation);
  return bounds.box();
}

Segment segment_of(const Point2<double>& a, const Point2<double>& b) { return {{a[0], a[1]}, {b[0], b[1]}}; }

LinePoints line_of(const PlacedFacet<2>& facet) { return {facet.x.begin(), facet.x.begin() + facet.count}; }

// The box of every rank.
template <int dim>
std::vector<Bounds<dim>> gather_bounds(const Communicator& comm, const std::vector<PlacedFacet<dim>>& facets, const std::vector<double>& radius) {
  Bounds<dim> mine;
  for (std::size_t f = 0; f < facets.size(); ++f) mine.enclose(facets[f], radius[f]);
  std::vector<Bounds<dim>> all(static_cast<std::size_t>(comm.getSize()));
  constexpr int count = 2 * dim;
  static_assert(sizeof(Bounds<dim>) == count * sizeof(double));
  Teuchos::gatherAll(comm, count, mine.low.data(), count * comm.getSize(), all.front().low.data());
  return all;
}

}  // namespace

double facet_distance(const LinePoints& a, const LinePoints& b) {
  if (a.size() == 2 && b.size() == 2) return geometry::distance(segment_of(a[0], a[1]), segment_of(b[0], b[1]));
  double least = std::numeric_limits<double>::max();
  for (const FacetPart& of_a : linear_parts(2, a.size()))
    for (const FacetPart& of_b : linear_parts(2, b.size()))
      least = std::min<double>(least, geometry::distance(segment_of(a[of_a[0]], a[of_a[1]]), segment_of(b[of_b[0]], b[of_b[1]])));
  return least;
}

template <int dim>
std::vector<std::vector<PlacedFacet<dim>>> facets_within(const Communicator& comm, const std::vector<PlacedFacet<dim>>& slave,
                                                         const std::vector<double>& radius, const std::vector<PlacedFacet<dim>>& master) {
  const auto bounds = gather_bounds<dim>(comm, slave, radius);
  std::vector<std::vector<PlacedFacet<dim>>> send(bounds.size());
  for (const PlacedFacet<dim>& facet : master) {
    const Box<dim> box = box_of(facet, 0.0);
    for (std::size_t r = 0; r < bounds.size(); ++r)
      if (!bounds[r].empty() && geometry::intersects(box, bounds[r].box())) send[r].push_back(facet);
  }
  std::vector<PlacedFacet<dim>> near;
  for (const auto& part : all_to_all(comm, send)) near.insert(near.end(), part.begin(), part.end());

  std::vector<std::pair<Box<dim>, std::size_t>> entries;
  for (std::size_t f = 0; f < near.size(); ++f) entries.emplace_back(box_of(near[f], 0.0), f);
  const geometry::index::rtree<std::pair<Box<dim>, std::size_t>, geometry::index::rstar<16>> tree(entries);

  std::vector<std::vector<PlacedFacet<dim>>> result(slave.size());
  std::vector<std::pair<Box<dim>, std::size_t>> hits;
  for (std::size_t f = 0; f < slave.size(); ++f) {
    hits.clear();
    tree.query(geometry::index::intersects(box_of(slave[f], radius[f])), std::back_inserter(hits));
    for (const auto& hit : hits) {
      const PlacedFacet<dim>& facet = near[hit.second];
      if constexpr (dim == 2)
        if (facet_distance(line_of(slave[f]), line_of(facet)) > radius[f]) continue;
      result[f].push_back(facet);
    }
    std::sort(result[f].begin(), result[f].end(), [](const PlacedFacet<dim>& a, const PlacedFacet<dim>& b) { return a.nodes < b.nodes; });
  }
  return result;
}

// No facet that a line meets is further from its node than the diagonal of the box of all nodes and facets: the line is cut off there.
template <int dim>
std::vector<std::optional<double>> distances_along_normals(const Communicator& comm, const std::vector<NormalLine<dim>>& lines,
                                                           const std::vector<PlacedFacet<dim>>& master) {
  using Point = Eigen::Matrix<double, dim, 1>;
  Bounds<dim> mine;
  for (const NormalLine<dim>& line : lines) mine.enclose(PlacedFacet<dim>({}, {line.x}), 0.0);
  for (const PlacedFacet<dim>& facet : master) mine.enclose(facet, 0.0);
  Bounds<dim> all;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, dim, mine.low.data(), all.low.data());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, dim, mine.high.data(), all.high.data());
  const double diagonal = (Eigen::Map<const Point>(all.high.data()) - Eigen::Map<const Point>(all.low.data())).norm();

  std::vector<PlacedFacet<dim>> cut_off;
  for (const NormalLine<dim>& line : lines) {
    const FacetPoints<dim> ends = {Point(line.x - diagonal * line.normal), Point(line.x + diagonal * line.normal)};
    cut_off.push_back({{}, ends});
  }
  const auto near = facets_within<dim>(comm, cut_off, std::vector<double>(lines.size(), on_facet * diagonal), master);
  std::vector<std::optional<double>> distances(lines.size());
  for (std::size_t n = 0; n < lines.size(); ++n)
    for (const PlacedFacet<dim>& facet : near[n])
      for (const FacetPart& part : linear_parts(dim, static_cast<std::size_t>(facet.count))) {
        const std::optional<double> distance = line_distance(lines[n].x, lines[n].normal, part_of(facet.points(), part));
        if (distance && (!distances[n] || std::abs(*distance) < std::abs(*distances[n]))) distances[n] = distance;
      }
  return distances;
}

template std::vector<std::vector<PlacedFacet<2>>> facets_within(const Communicator&, const std::vector<PlacedFacet<2>>&, const std::vector<double>&,
                                                                const std::vector<PlacedFacet<2>>&);
template std::vector<std::vector<PlacedFacet<3>>> facets_within(const Communicator&, const std::vector<PlacedFacet<3>>&, const std::vector<double>&,
                                                                const std::vector<PlacedFacet<3>>&);
template std::vector<std::optional<double>> distances_along_normals(const Communicator&, const std::vector<NormalLine<2>>&,
                                                                    const std::vector<PlacedFacet<2>>&);
template std::vector<std::optional<double>> distances_along_normals(const Communicator&, const std::vector<NormalLine<3>>&,
                                                                    const std::vector<PlacedFacet<3>>&);

}  // namespace mortise
