// Where a slave and a master facet lie over one another in 3D.

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "integrals/triangle_points.hpp"
#include "mortise/core/error.hpp"
#include "mortise/mortar/segment_3d.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {
namespace {

/// Sine of the angle that a master facet has to keep from standing upright on the plane.
constexpr double facing_tolerance = 0.05;

/// Of the slave facet's area: a smaller overlap is short as well, as its edges do not coincide, and carries nothing. A long one counts however narrow
/// it is: what its edges add by their motion depends on their length.
constexpr double no_area = 1e-20;

StepFailure too_distorted() {
  return {FailureKind::projection, "a point of a contact facet cannot be projected on the opposite one, which is too distorted"};
}

// The xi with sum N_a(xi) x_a = s: of triangles, whose map is x_0 + (x_1 - x_0) xi + (x_2 - x_0) eta.
Eigen::Vector2d invert_triangle(const FacetVectors& x, const Eigen::Vector2d& s) {
  Eigen::Matrix2d slope;
  slope << (x[1] - x[0]).head<2>(), (x[2] - x[0]).head<2>();
  return slope.inverse() * (s - x[0].head<2>());
}

// Inverts the map of quadrilaterals, c + a xi + b eta + d xi eta, by Newton's method; it starts from the result for a parallelogram (d = 0).
Eigen::Vector2d invert_quadrilateral(const FacetVectors& x, const Eigen::Vector2d& s) {
  const Eigen::Vector2d offset = s - 0.25 * (x[0] + x[1] + x[2] + x[3]).head<2>(), a = 0.25 * (x[1] + x[2] - x[0] - x[3]).head<2>(),
                        b = 0.25 * (x[2] + x[3] - x[0] - x[1]).head<2>(), d = 0.25 * (x[0] + x[2] - x[1] - x[3]).head<2>();
  const auto solve = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v, const Eigen::Vector2d& right) {
    const double scale = 1.0 / (u[0] * v[1] - u[1] * v[0]);
    return Eigen::Vector2d(scale * (right[0] * v[1] - right[1] * v[0]), scale * (u[0] * right[1] - u[1] * right[0]));
  };
  Eigen::Vector2d xi = solve(a, b, offset);
  constexpr double parallelogram = 1e-28;
  if (d.squaredNorm() < parallelogram * std::min(a.squaredNorm(), b.squaredNorm())) return xi;
  constexpr int most = 40;
  for (int iteration = 0; iteration < most; ++iteration) {
    const Eigen::Vector2d step = solve(a + d * xi[1], b + d * xi[0], offset - a * xi[0] - b * xi[1] - d * (xi[0] * xi[1]));
    xi += step;
    constexpr double settled = 1e-9;  // the next step would be of its square
    if (step.squaredNorm() < settled * settled) return xi;
  }
  throw too_distorted();
}

// Inverts the map of quadratic facets by Newton's method. It starts from the map of the part that is affine and right at three of its corners.
template <class Shape>
Eigen::Vector2d invert_quadratic(const FacetVectors& x, const FacetPart& part, const Eigen::Vector2d& s) {
  const auto reference = [&](int a) { return Eigen::Map<const Eigen::Vector2d>(Shape::node_positions[a].data()); };
  const Eigen::Vector2d start = invert_triangle({x[part[0]], x[part[1]], x[part.back()]}, s);
  Eigen::Vector2d xi =
      reference(part[0]) + (reference(part[1]) - reference(part[0])) * start[0] + (reference(part.back()) - reference(part[0])) * start[1];
  constexpr int most = 40;
  for (int iteration = 0; iteration < most; ++iteration) {
    const std::array<double, 2> at = {xi[0], xi[1]};
    const auto N = Shape::values(at);
    const auto G = Shape::gradients(at);
    Eigen::Vector2d rest = s;
    Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
    for (int a = 0; a < Shape::nodes; ++a) {
      rest -= N[a] * x[a].template head<2>();
      slope += x[a].template head<2>() * Eigen::RowVector2d(G[a][0], G[a][1]);
    }
    const Eigen::Vector2d step = slope.inverse() * rest;
    xi += step;
    constexpr double settled = 1e-9;  // the next step would be of its square
    if (step.norm() < settled) return xi;
  }
  throw too_distorted();
}

PlanePolygon project(const FacetVectors& nodes) {
  PlanePolygon polygon;
  for (const Eigen::Vector3d& x : nodes) polygon.push_back(x.head<2>());
  return polygon;
}

bool apart(const FacetVectors& a, const FacetVectors& b) {
  for (int i = 0; i < 2; ++i) {
    const auto less = [i](const Eigen::Vector3d& x, const Eigen::Vector3d& y) { return x[i] < y[i]; };
    const auto of_a = std::minmax_element(a.begin(), a.end(), less), of_b = std::minmax_element(b.begin(), b.end(), less);
    if ((*of_a.second)[i] <= (*of_b.first)[i] || (*of_b.second)[i] <= (*of_a.first)[i]) return true;
  }
  return false;
}

template <class Shape>
Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1> values_of(const Eigen::Vector2d& xi) {
  const auto N = Shape::values(std::array<double, 2>{xi[0], xi[1]});
  return Eigen::Map<const Eigen::Matrix<double, Shape::nodes, 1>>(N.data());
}

// Fan triangles of a polygon about the mean of its vertices, which is put behind them.
void cut_into_triangles(Overlap3d& overlap, boost::container::static_vector<Eigen::Vector2d, 17>& vertices) {
  const auto count = static_cast<int>(overlap.polygon.size());
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const ClipVertex& vertex : overlap.polygon) {
    vertices.push_back(vertex.position);
    centre += vertex.position / count;
  }
  vertices.push_back(centre);
  if (count == 3)
    overlap.triangles.push_back({0, 1, 2});
  else
    for (int v = 0; v < count; ++v) overlap.triangles.push_back({count, v, (v + 1) % count});
}

// Adds the overlap of two parts whose nodes are given, if there is one.
void add_overlap(const FacetVectors& slave, const FacetPart& slave_part, const FacetVectors& slave_nodes, const FacetVectors& master,
                 const FacetPart& master_part, const FacetVectors& master_nodes, std::vector<Overlap3d>& overlaps) {
  if (apart(slave_nodes, master_nodes)) return;
  const PlanePolygon first = project(slave_nodes);
  const ClipPolygon polygon = clip_convex(first, project(master_nodes));
  if (polygon.size() < 3) return;
  Overlap3d& overlap = overlaps.emplace_back();
  overlap.slave_part = slave_part;
  overlap.master_part = master_part;
  overlap.polygon = polygon;
  boost::container::static_vector<Eigen::Vector2d, 17> vertices;
  cut_into_triangles(overlap, vertices);
  double area = 0.0, whole = 0.0;
  for (const auto& [a, b, c] : overlap.triangles) area += doubled_area(vertices[a], vertices[b], vertices[c]);
  for (std::size_t a = 2; a < first.size(); ++a) whole += doubled_area(first[0], first[a - 1], first[a]);
  if (!(area > no_area * whole)) {
    overlaps.pop_back();
    return;
  }
  overlap.distance = std::numeric_limits<double>::max();
  for (const auto& [a, b, c] : overlap.triangles) {
    const double twice = doubled_area(vertices[a], vertices[b], vertices[c]);
    for (const TrianglePoint& one : triangle_points(slave.size())) {
      const Eigen::Vector2d s = one.share[0] * vertices[a] + one.share[1] * vertices[b] + one.share[2] * vertices[c];
      OverlapPoint point;
      point.xi = facet_coordinates(slave, slave_part, s);
      point.eta = facet_coordinates(master, master_part, s);
      point.weight = one.weight * twice;
      point.height = height_at(master, point.eta) - height_at(slave, point.xi);
      overlap.distance = std::min(overlap.distance, std::abs(point.height));
      overlap.points.push_back(point);
    }
  }
}

}  // namespace

Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1> facet_values(std::size_t nodes, const Eigen::Vector2d& xi) {
  switch (nodes) {
    case 3:
      return values_of<Triangle3>(xi);
    case 4:
      return values_of<Quadrilateral4>(xi);
    case 6:
      return values_of<Triangle6>(xi);
    default:
      return values_of<Quadrilateral8>(xi);
  }
}

bool faces(const FacetVectors& master) { return shows_side(master, -1.0, facing_tolerance); }

Eigen::Vector2d facet_coordinates(const FacetVectors& nodes, const FacetPart& part, const Eigen::Vector2d& s) {
  switch (nodes.size()) {
    case 3:
      return invert_triangle(nodes, s);
    case 4:
      return invert_quadrilateral(nodes, s);
    case 6:
      return invert_quadratic<Triangle6>(nodes, part, s);
    default:
      return invert_quadratic<Quadrilateral8>(nodes, part, s);
  }
}

double height_at(const FacetVectors& nodes, const Eigen::Vector2d& xi) {
  const auto N = facet_values(nodes.size(), xi);
  double sum = 0.0;
  for (std::size_t a = 0; a < nodes.size(); ++a) sum += N[static_cast<Eigen::Index>(a)] * nodes[a].z();
  return sum;
}

void find_overlaps(const FacetVectors& slave, const FacetVectors& master, std::vector<Overlap3d>& overlaps) {
  if (apart(slave, master)) return;
  for (const FacetPart& master_part : linear_parts(3, master.size())) {
    const FacetVectors master_nodes = part_of(master, master_part);
    if (!faces(master_nodes)) continue;
    for (const FacetPart& slave_part : linear_parts(3, slave.size()))
      add_overlap(slave, slave_part, part_of(slave, slave_part), master, master_part, master_nodes, overlaps);
  }
}

}  // namespace mortise
