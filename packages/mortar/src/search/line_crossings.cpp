#include "mortise/mortar/line_crossings.hpp"

#include <Eigen/Geometry>
#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <optional>

#include "exchange/exchange.hpp"
#include "geometry/facet_geometry.hpp"
#include "mortise/mortar/facet_surface.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "search/curved_crossings.hpp"
#include "search/line_distance.hpp"

namespace mortise {
namespace {

namespace geometry = boost::geometry;
using TreePoint = geometry::model::point<double, 3, geometry::cs::cartesian>;
using TreeBox = geometry::model::box<TreePoint>;
using TreeSegment = geometry::model::segment<TreePoint>;

/// Distance of surface points from nodes, over that of the centre.
constexpr double inset = 1e-5;
/// Bend of mid-side nodes from the mid-points of their edges, over the size of the facet, below which a facet is made of its linear parts.
constexpr double straight = 1e-12;

TreePoint tree_point(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }

/// A linear facet, or a curved quadratic one, as it travels.
struct Piece {
  std::array<double, 3 * most_side_nodes> x{};
  int count = 0, tag = 0;
  bool is_curved = false;

  Piece() = default;
  Piece(const FacetPlaces& points, int of, bool curved) : count(static_cast<int>(points.size())), tag(of), is_curved(curved) {
    double* to = x.data();
    for (const Eigen::Vector3d& point : points) to = std::copy(point.begin(), point.end(), to);
  }
  Eigen::Vector3d point(int a) const { return Eigen::Map<const Eigen::Vector3d>(&x[3 * static_cast<std::size_t>(a)]); }
  FacetPlaces points() const {
    FacetPlaces all;
    for (int a = 0; a < count; ++a) all.push_back(point(a));
    return all;
  }
  Box3 box(int dimension) const {
    Box3 box;
    if (is_curved && dimension == 3)
      for (const Eigen::Vector3d& one : control_points<3>(points())) box.enclose(one);
    else
      for (int a = 0; a < count; ++a) box.enclose(point(a));
    // x_2 - (x_0 + x_1)/2 is the most that a line of 3 nodes rises above its chord: the control point is twice as high.
    if (is_curved && dimension == 2) box.enclose(2.0 * point(2) - 0.5 * (point(0) + point(1)));
    return box;
  }
};

std::vector<Piece> pieces_of(int dimension, const std::vector<TaggedFacet>& facets) {
  std::vector<Piece> pieces;
  for (const TaggedFacet& facet : facets) {
    if (bend_of(dimension, facet.points) > straight * (facet.points[1] - facet.points[0]).norm())
      pieces.emplace_back(facet.points, facet.tag, true);
    else
      for (const FacetPart& part : linear_parts(dimension, facet.points.size())) pieces.emplace_back(part_of(facet.points, part), facet.tag, false);
  }
  return pieces;
}

double cross_2d(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// @param least  sine of the angle between line and facet below which they do not cross
std::optional<Crossing> cross_line(const LineSegment& line, const Piece& piece, double least) {
  const Eigen::Vector3d along = piece.point(1) - piece.point(0), offset = piece.point(0) - line.x;
  const double across = cross_2d(line.d, along), length = along.norm();  // the outward normal is (along_y, -along_x)
  if (std::abs(across) < least * length || across == 0.0) return std::nullopt;
  const double place = cross_2d(offset, line.d) / across;
  if (place < -on_facet || place > 1.0 + on_facet) return std::nullopt;
  return Crossing{cross_2d(offset, along) / across, across > 0.0, piece.tag, across / length, Eigen::Vector3d(along[1], -along[0], 0.0) / length};
}

std::optional<Crossing> cross_triangle(const LineSegment& line, const Piece& piece, int second, double least) {
  const Eigen::Vector3d a = piece.point(0) - line.x, e = piece.point(second) - piece.point(0), f = piece.point(second + 1) - piece.point(0),
                        normal = e.cross(f);
  const double across = line.d.dot(normal);
  if (std::abs(across) < least * normal.norm() || across == 0.0) return std::nullopt;
  const double s = a.dot(normal) / across;
  const Eigen::Vector3d at = s * line.d - a;
  const double u = at.cross(f).dot(normal) / normal.squaredNorm(), v = e.cross(at).dot(normal) / normal.squaredNorm();
  if (u < -on_facet || v < -on_facet || u + v > 1.0 + on_facet) return std::nullopt;
  return Crossing{s, across > 0.0, piece.tag, across / normal.norm(), normal.normalized()};
}

void cross(int dimension, const LineSegment& line, const Piece& piece, double least, std::vector<Crossing>& all) {
  if (piece.is_curved) return cross_curved(dimension, line, piece.points(), piece.tag, least, all);
  std::optional<Crossing> found = dimension == 2 ? cross_line(line, piece, least) : cross_triangle(line, piece, 1, least);
  if (!found && piece.count == 4) found = cross_triangle(line, piece, 2, least);
  if (found && found->s >= line.low && found->s <= line.high) all.push_back(*found);
}

Box3 box_of(const LineSegment& line) {
  Box3 box;
  box.enclose(line.x + line.low * line.d);
  box.enclose(line.x + line.high * line.d);
  return box;
}

}  // namespace

Box3 Box3::widened(double by) const {
  Box3 wider = *this;
  wider.low.array() -= by;
  wider.high.array() += by;
  return wider;
}

bool Box3::cut(LineSegment& segment) const {
  for (int i = 0; i < 3; ++i) {
    if (segment.d[i] == 0.0) {
      if (segment.x[i] < low[i] || segment.x[i] > high[i]) return false;
      continue;
    }
    const double a = (low[i] - segment.x[i]) / segment.d[i], b = (high[i] - segment.x[i]) / segment.d[i];
    segment.low = std::max(segment.low, std::min(a, b));
    segment.high = std::min(segment.high, std::max(a, b));
  }
  return segment.low <= segment.high;
}

std::vector<Box3> boxes_over_ranks(const Communicator& comm, const std::vector<Box3>& mine) {
  std::vector<double> values, all;
  for (const Box3& box : mine)
    for (int i = 0; i < 3; ++i) values.insert(values.end(), {-box.low[i], box.high[i]});
  all.resize(values.size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, static_cast<int>(values.size()), values.data(), all.data());
  std::vector<Box3> boxes(mine.size());
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (std::size_t i = 0; i < 3; ++i) {
      boxes[b].low[static_cast<Eigen::Index>(i)] = -all[6 * b + 2 * i];
      boxes[b].high[static_cast<Eigen::Index>(i)] = all[6 * b + 2 * i + 1];
    }
  return boxes;
}

namespace {

std::vector<SurfacePoint> points_of_linear(int dimension, const FacetPlaces& x) {
  std::vector<SurfacePoint> points;
  Eigen::Vector3d normal, centre = Eigen::Vector3d::Zero();
  if (dimension == 2)
    normal = {x[1][1] - x[0][1], x[0][0] - x[1][0], 0.0};
  else
    normal = central_normal(x);
  if (!(normal.norm() > 0.0)) return points;
  normal.normalize();
  for (const Eigen::Vector3d& corner : x) centre += corner / static_cast<double>(x.size());
  for (std::size_t a = 0; a < x.size(); ++a)
    points.push_back({x[a] + inset * (centre - x[a]), normal, static_cast<int>(a), (centre - x[a]).normalized()});
  points.push_back({centre, normal, 0});
  return points;
}

}  // namespace

std::vector<SurfacePoint> surface_points(int dimension, const FacetPlaces& facet) {
  if (facet.size() == facet_corners(dimension, facet.size())) return points_of_linear(dimension, facet);
  std::vector<SurfacePoint> points;
  for (const FacetPart& part : linear_parts(dimension, facet.size())) {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (const int a : part) centre += facet_node(dimension, facet.size(), static_cast<std::size_t>(a)) / static_cast<double>(part.size());
    const FacetPoint middle = facet_point(dimension, facet, centre);
    const auto add = [&](const FacetPoint& point, int node, const Eigen::Vector3d& inward) {
      if (const double size = point.normal.norm(); size > 0.0) points.push_back({point.x, point.normal / size, node, inward});
    };
    for (const int a : part) {
      const Eigen::Vector2d xi = facet_node(dimension, facet.size(), static_cast<std::size_t>(a));
      const FacetPoint point = facet_point(dimension, facet, xi + inset * (centre - xi));
      add(point, a, (middle.x - point.x).normalized());
    }
    add(middle, part[0], Eigen::Vector3d::Zero());
  }
  return points;
}

std::vector<std::vector<Crossing>> crossings(const Communicator& comm, int dimension, const std::vector<TaggedFacet>& facets,
                                             const std::vector<LineSegment>& segments, Grazing grazing) {
  const double least = grazing == Grazing::counted ? 0.0 : grazing_angle;
  Box3 mine;
  double length = 0.0;
  for (const LineSegment& segment : segments) {
    const Box3 box = box_of(segment);
    mine.enclose(box.low);
    mine.enclose(box.high);
    length = std::max(length, segment.high - segment.low);
  }
  const double slack = on_facet * length;
  if (!mine.empty()) mine = mine.widened(slack);
  std::vector<double> own, all(6 * static_cast<std::size_t>(comm.getSize()));
  for (int i = 0; i < 3; ++i) own.insert(own.end(), {mine.low[i], mine.high[i]});
  Teuchos::gatherAll(comm, 6, own.data(), static_cast<int>(all.size()), all.data());
  std::vector<Box3> boxes(static_cast<std::size_t>(comm.getSize()));
  for (std::size_t r = 0; r < boxes.size(); ++r)
    for (std::size_t i = 0; i < 3; ++i) {
      boxes[r].low[static_cast<Eigen::Index>(i)] = all[6 * r + 2 * i];
      boxes[r].high[static_cast<Eigen::Index>(i)] = all[6 * r + 2 * i + 1];
    }
  std::vector<std::vector<Crossing>> result(segments.size());
  if (std::all_of(boxes.begin(), boxes.end(), [](const Box3& box) { return box.empty(); })) return result;

  std::vector<std::vector<Piece>> send(boxes.size());
  for (const Piece& piece : pieces_of(dimension, facets))
    for (std::size_t r = 0; r < boxes.size(); ++r)
      if (!boxes[r].empty() && boxes[r].meets(piece.box(dimension))) send[r].push_back(piece);
  std::vector<Piece> near;
  for (const auto& part : all_to_all(comm, send)) near.insert(near.end(), part.begin(), part.end());

  std::vector<std::pair<TreeBox, std::size_t>> entries;
  for (std::size_t p = 0; p < near.size(); ++p) {
    const Box3 box = near[p].box(dimension), wider = box.widened(slack + on_facet * box.diagonal());
    entries.emplace_back(TreeBox(tree_point(wider.low), tree_point(wider.high)), p);
  }
  const geometry::index::rtree<std::pair<TreeBox, std::size_t>, geometry::index::rstar<16>> tree(entries);
  std::vector<std::pair<TreeBox, std::size_t>> hits;
  for (std::size_t n = 0; n < segments.size(); ++n) {
    const LineSegment& line = segments[n];
    hits.clear();
    tree.query(geometry::index::intersects(TreeSegment(tree_point(line.x + line.low * line.d), tree_point(line.x + line.high * line.d))),
               std::back_inserter(hits));
    for (const auto& hit : hits) cross(dimension, line, near[hit.second], least, result[n]);
    std::sort(result[n].begin(), result[n].end(),
              [](const Crossing& a, const Crossing& b) { return std::tie(a.s, a.tag, a.leaves) < std::tie(b.s, b.tag, b.leaves); });
  }
  return result;
}

}  // namespace mortise
