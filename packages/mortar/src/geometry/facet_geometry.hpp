#pragma once
// Sizes of facets in 2D (lines) and in 3D (triangles and quadrilaterals), linear and quadratic.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {

template <int dim>
using Positions = std::vector<Eigen::Matrix<double, dim, 1>>;

template <int dim>
inline constexpr std::size_t most_facet_nodes = dim == 2 ? 3 : 8;

/// Positions of the nodes of a facet, in order.
template <int dim>
using FacetPoints = boost::container::static_vector<Eigen::Matrix<double, dim, 1>, most_facet_nodes<dim>>;

template <int dim, class Nodes>
FacetPoints<dim> points_of(const Nodes& nodes, const Positions<dim>& x) {
  FacetPoints<dim> points;
  for (const auto node : nodes) points.push_back(x[static_cast<std::size_t>(node)]);
  return points;
}

/// Points whose convex hull holds the facet: the coefficients of its position in functions that are >= 0. Of linear facets the nodes.
template <int dim>
FacetPoints<dim> control_points(const FacetPoints<dim>& x) {
  const NonNegativeBasis* basis = non_negative_basis(dim, x.size());
  if (basis == nullptr) return x;
  FacetPoints<dim> points(x.size(), Eigen::Matrix<double, dim, 1>::Zero());
  for (std::size_t a = 0; a < x.size(); ++a)
    for (std::size_t b = 0; b < x.size(); ++b) points[b] += basis->to_shape(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) * x[a];
  return points;
}

/// Calls act(a, b) for the ends of each edge; a line is its own only one.
template <int dim, class Act>
void for_each_edge(const FacetPoints<dim>& x, const Act& act) {
  const std::size_t corners = facet_corners(dim, x.size()), edges = dim == 2 ? 1 : corners;
  for (std::size_t a = 0; a < edges; ++a) act(x[a], x[(a + 1) % corners]);
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

/// Normal of a linear facet at its centre times an area: c of AuxiliaryPlane.
inline Eigen::Vector3d central_normal(const FacetPoints<3>& x) {
  return x.size() == 3 ? (x[1] - x[0]).cross(x[2] - x[0]) : (x[2] - x[0]).cross(x[3] - x[1]);
}

/// The height H of a facet bounds how far its normals turn. If no node moves further than d, the sine of the angle is at most 2 d / H (to first
/// order). 0 without extent.
///   - A line of 2 nodes: its length.
///   - A line of 3 nodes: half the least |dx/dxi| of the nodes. It changes by 4 d at most, as at the first node, where it is -3/2 x_0 - 1/2 x_1 + 2
///     x_2.
///   - A triangle: its least height.
///   - A quadrilateral: its area over the longer line between the midpoints of opposite edges.
///   - A quadratic facet in 3D: the least height of its linear parts, which are what is compared with the other side.
inline double facet_height(const FacetPoints<2>& x) {
  if (x.size() == 2) return (x[1] - x[0]).norm();
  const Eigen::Vector2d along = 0.5 * (x[1] - x[0]), bend = x[0] + x[1] - 2.0 * x[2];
  return 0.5 * std::min({along.norm(), (along - bend).norm(), (along + bend).norm()});
}

inline double facet_height(const FacetPoints<3>& x) {
  if (const auto& parts = linear_parts(3, x.size()); parts.size() > 1) {
    double least = std::numeric_limits<double>::max();
    for (const FacetPart& part : parts) least = std::min(least, facet_height(part_of(x, part)));
    return least;
  }
  const double twice_area = central_normal(x).norm();
  const double width = x.size() == 3 ? longest_edge<3>(x) : std::max((x[2] - x[0] + x[3] - x[1]).norm(), (x[2] - x[0] - x[3] + x[1]).norm());
  return width > 0.0 ? twice_area / width : 0.0;
}

}  // namespace mortise
