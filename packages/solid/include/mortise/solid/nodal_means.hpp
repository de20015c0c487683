#pragma once
// From the quadrature points of an element to its nodes.

#include <Eigen/Core>

#include "mortise/solid/element_type.hpp"

namespace mortise {

/// [nodes x points]: values at the nodes of an element from those at its quadrature points. They are those of the polynomial that fits the points
/// best. Its terms are 1, xi_i on simplices, all products of the 1, xi_i on squares and cubes, those of 1, xi, eta with 1, zeta on wedges. On
/// pyramids they are products of 1, u with 1, v, the coordinates of rays, and the apex gets what the axis has. Points that are too few determine the
/// smallest coefficients about the centroid: one point gives a constant. Constants are exact; so is whatever the polynomials hold.
Eigen::MatrixXd extrapolation_to_nodes(ElementType element, Kinematics kinematics);

}  // namespace mortise
