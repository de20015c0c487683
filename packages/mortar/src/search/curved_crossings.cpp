#include "search/curved_crossings.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>

#include "geometry/facet_geometry.hpp"
#include "mortise/mortar/facet_surface.hpp"
#include "mortise/mortar/quadratic_facet.hpp"
#include "search/line_distance.hpp"

namespace mortise {
namespace {

using Roots = boost::container::static_vector<Eigen::Vector2d, 8>;

void add(const LineSegment& line, const FacetPoint& point, int tag, double least, std::vector<Crossing>& found) {
  const double s = line.d.dot(point.x - line.x), size = point.normal.norm();
  if (!(size > 0.0) || s < line.low || s > line.high) return;
  const double along = line.d.dot(point.normal) / size;
  if (std::abs(along) >= least && along != 0.0) found.push_back({s, along > 0.0, tag, along, point.normal / size});
}

// x(xi) = x_2 + xi (x_1 - x_0)/2 + xi^2 ((x_0 + x_1)/2 - x_2) has the distance d x (x(xi) - x) = A xi^2 + B xi + C from the line.
Roots roots_on_line(const LineSegment& line, const FacetPlaces& facet) {
  const auto distance = [&](const Eigen::Vector3d& v) { return line.d[0] * v[1] - line.d[1] * v[0]; };
  const double A = distance(0.5 * (facet[0] + facet[1]) - facet[2]), B = 0.5 * distance(facet[1] - facet[0]), C = distance(facet[2] - line.x);
  const double discriminant = B * B - 4.0 * A * C;
  Roots roots;
  if (discriminant < 0.0) return roots;
  const double q = -0.5 * (B + std::copysign(std::sqrt(discriminant), B));
  if (q != 0.0) roots.push_back({C / q, 0.0});
  if (A != 0.0 && (roots.empty() || q / A != roots[0][0])) roots.push_back({q / A, 0.0});
  return roots;
}

/// Newton's method from the middle of each linear part: a facet that is not folded meets a line at most once in each. No convergence means no root.
Roots roots_on_surface(const LineSegment& line, const FacetPlaces& facet) {
  constexpr int most_iterations = 20;
  constexpr double far_off = 4.0, converged = 1e-13, same = 1e-6;  // in reference coordinates
  Eigen::Matrix<double, 2, 3> across;
  across.row(0) = line.d.unitOrthogonal().transpose();
  across.row(1) = line.d.cross(line.d.unitOrthogonal()).transpose();
  Roots roots;
  // The facet lies in the hull of its control points.
  Eigen::AlignedBox2d hull;
  for (const Eigen::Vector3d& point : control_points<3>(facet)) hull.extend(Eigen::Vector2d(across * (point - line.x)));
  const Eigen::Vector2d slack = Eigen::Vector2d::Constant(on_facet * hull.diagonal().norm());
  if (!Eigen::AlignedBox2d(hull.min() - slack, hull.max() + slack).contains(Eigen::Vector2d::Zero())) return roots;
  for (const FacetPart& part : linear_parts(3, facet.size())) {
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();
    for (const int a : part) xi += facet_node(3, facet.size(), static_cast<std::size_t>(a)) / static_cast<double>(part.size());
    for (int iteration = 0; iteration < most_iterations && xi.norm() < far_off; ++iteration) {
      const FacetPoint at = facet_point(3, facet, xi);
      Eigen::Matrix2d slope;
      slope.col(0) = across * at.tangent[0];
      slope.col(1) = across * at.tangent[1];
      const Eigen::Vector2d step = slope.inverse() * (across * (line.x - at.x));
      if (!step.allFinite()) break;
      xi += step;
      if (step.norm() > converged) continue;
      if (std::none_of(roots.begin(), roots.end(), [&](const Eigen::Vector2d& root) { return (root - xi).norm() < same; })) roots.push_back(xi);
      break;
    }
  }
  return roots;
}

bool is_on_facet(int dimension, std::size_t nodes, const Eigen::Vector2d& xi) {
  if (dimension == 2) return std::abs(xi[0]) <= 1.0 + on_facet;
  if (facet_corners(3, nodes) == 4) return xi.cwiseAbs().maxCoeff() <= 1.0 + on_facet;
  return xi.minCoeff() >= -on_facet && xi.sum() <= 1.0 + on_facet;
}

}  // namespace

void cross_curved(int dimension, const LineSegment& line, const FacetPlaces& facet, int tag, double least, std::vector<Crossing>& found) {
  for (const Eigen::Vector2d& xi : dimension == 2 ? roots_on_line(line, facet) : roots_on_surface(line, facet))
    if (is_on_facet(dimension, facet.size(), xi)) add(line, facet_point(dimension, facet, xi), tag, least, found);
}

}  // namespace mortise
