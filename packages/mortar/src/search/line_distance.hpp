#pragma once
// Where a line along a normal meets a linear master facet.

#include <Eigen/Core>
#include <optional>

#include "geometry/facet_geometry.hpp"

namespace mortise {

/// Beyond the edges of a facet, in its size: no line passes between two facets.
inline constexpr double on_facet = 1e-9;

/// s of the point x + s n (n a unit vector) of the facet; none if the line misses it, or it does not face n.
std::optional<double> line_distance(const Eigen::Vector2d& x, const Eigen::Vector2d& n, const FacetPoints<2>& facet);
std::optional<double> line_distance(const Eigen::Vector3d& x, const Eigen::Vector3d& n, const FacetPoints<3>& facet);

}  // namespace mortise
