#pragma once
// Points of facets as they are, quadratic ones as curved as their functions make them.

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "mortise/mortar/line_crossings.hpp"

namespace mortise {

/// A point of a facet.
struct FacetPoint {
  Eigen::Vector3d x;                       ///< its place
  std::array<Eigen::Vector3d, 2> tangent;  ///< dx/dxi_i; in 2D the second is 0
  Eigen::Vector3d normal;                  ///< outwards; not of unit length
};

/// The point at reference coordinates xi; in 2D xi.y is 0.
FacetPoint facet_point(int dimension, const FacetPlaces& facet, const Eigen::Vector2d& xi);

/// Reference coordinates of a node of a facet with so many nodes.
Eigen::Vector2d facet_node(int dimension, std::size_t nodes, std::size_t node);

/// The most by which mid-side nodes lie off the mid-points of their edges; 0 of linear facets. Straight and evenly spaced edges have none.
double bend_of(int dimension, const FacetPlaces& facet);

}  // namespace mortise
