#pragma once
// From the quadrature points of an element to its nodes.

#include <Eigen/Core>

#include "mortise/solid/element_type.hpp"

namespace mortise {

/// [nodes x points]: values at the nodes of an element from those at its quadrature points. They are those of the polynomial that fits the points
/// best: 1, xi_i on simplices, all products of the 1, xi_i on squares and cubes. Points that are too few for that determine its smallest coefficients
/// about the centroid: one point gives a constant. Constants are exact; so is whatever the polynomials hold.
Eigen::MatrixXd extrapolation_to_nodes(ElementType element, Kinematics kinematics);

}  // namespace mortise
