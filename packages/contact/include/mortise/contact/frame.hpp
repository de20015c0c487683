#pragma once
// The orthonormal frame of a slave node, and how its tangents turn with its normal.

#include <Eigen/Core>
#include <array>

#include "mortise/core/spatial.hpp"

namespace mortise {

/// Components along the tangents of a node: one in 2D, two in 3D.
using TangentVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2, 1>;
/// Maps one of them to another.
using TangentMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 2>;

/// n and the tangents tau_a, which are functions of n alone:  d tau_a = turn[a] dn  for dn . n = 0.
struct Frame {
  SpatialVector normal;                                                                   ///< n, of length 1
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 3> tangents;  ///< rows tau_a
  std::array<SpatialMatrix, 2> turn;                                                      ///< the first tangents.rows() count

  Eigen::Index dimension() const { return normal.size(); }  ///< 2 or 3
};

/// In 2D: n turned by +90 degrees.
Eigen::Vector2d tangent(const Eigen::Vector2d& normal);

/// In 3D tau_1 = (e - (e . n) n) / |...|, tau_2 = n x tau_1, with the coordinate axis e, which must not be parallel to n. In 2D e is not used.
Frame make_frame(const SpatialVector& normal, int axis);

/// The coordinate axis that is furthest from parallel to n.
int transverse_axis(const SpatialVector& normal);

}  // namespace mortise
