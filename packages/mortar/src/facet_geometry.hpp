#pragma once
// Sizes of facets in the plane (lines) and in space (triangles and quadrilaterals).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace mortise {

template <int dim>
using Positions = std::vector<Eigen::Matrix<double, dim, 1>>;

template <int dim>
inline constexpr std::size_t most_corners = dim == 2 ? 2 : 4;

/// Positions of the nodes of a linear facet, in order.
template <int dim>
using FacetPoints = boost::container::static_vector<Eigen::Matrix<double, dim, 1>, most_corners<dim>>;

template <int dim, class Nodes>
FacetPoints<dim> points_of(const Nodes& nodes, const Positions<dim>& x) {
  FacetPoints<dim> points;
  for (const auto node : nodes) points.push_back(x[static_cast<std::size_t>(node)]);
  return points;
}

/// Calls act(a, b) for each edge; a line is its own only one.
template <int dim, class Act>
void for_each_edge(const FacetPoints<dim>& x, const Act& act) {
  const std::size_t edges = dim == 2 ? 1 : x.size();
  for (std::size_t a = 0; a < edges; ++a) act(x[a], x[(a + 1) % x.size()]);
}

template <int dim>
double longest_edge(const FacetPoints<dim>& x) {
  double longest = 0.0;
  for_each_edge<dim>(x, [&](const auto& a, const auto& b) { longest = std::max(longest, (b - a).norm()); });
  return longest;
}

template <int dim>
double shortest_edge(const FacetPoints<dim>& x) {
  double shortest = std::numeric_limits<double>::max();
  for_each_edge<dim>(x, [&](const auto& a, const auto& b) { shortest = std::min(shortest, (b - a).norm()); });
  return shortest;
}

/// Normal at the centre times an area: c of AuxiliaryPlane.
inline Eigen::Vector3d central_normal(const FacetPoints<3>& x) {
  return x.size() == 3 ? (x[1] - x[0]).cross(x[2] - x[0]) : (x[2] - x[0]).cross(x[3] - x[1]);
}

/// Outward normal of a line times its length.
inline Eigen::Vector2d central_normal(const FacetPoints<2>& x) { return {x[1].y() - x[0].y(), x[0].x() - x[1].x()}; }

/// The height H of a facet bounds how far its normal turns: if no node moves further than d, the sine of the angle is at most 2 d / H (to first
/// order). Its length in the plane; the least height of a triangle; the area over the longer line between the middles of opposite edges of a
/// quadrilateral. 0 without area.
inline double facet_height(const FacetPoints<2>& x) { return (x[1] - x[0]).norm(); }

inline double facet_height(const FacetPoints<3>& x) {
  const double twice_area = central_normal(x).norm();
  const double width = x.size() == 3 ? longest_edge<3>(x) : std::max((x[2] - x[0] + x[3] - x[1]).norm(), (x[2] - x[0] - x[3] + x[1]).norm());
  return width > 0.0 ? twice_area / width : 0.0;
}

}  // namespace mortise
