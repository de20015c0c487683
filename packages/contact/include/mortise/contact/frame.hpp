#pragma once
// The orthonormal frame of a slave node, and how its tangents turn with its normal.

#include <Eigen/Geometry>
#include <array>

#include "mortise/core/spatial.hpp"

namespace mortise {

/// Components along the tangents of a node: one in the plane, two in space.
using TangentVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2, 1>;
using TangentMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 2>;

/// n and the tangents tau_a, which are functions of n alone:  d tau_a = turn[a] dn  for dn . n = 0.
struct Frame {
  SpatialVector normal;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 3> tangents;  ///< rows tau_a
  std::array<SpatialMatrix, 2> turn;                                                      ///< the first tangents.rows() count

  Eigen::Index dimension() const { return normal.size(); }
};

/// In the plane: n turned by +90 degrees.
inline Eigen::Vector2d tangent(const Eigen::Vector2d& normal) { return {-normal.y(), normal.x()}; }

/// In space tau_1 = (e - (e . n) n) / |...|, tau_2 = n x tau_1, with the coordinate axis e, which must not be parallel to n. In the plane e is not
/// used.
inline Frame make_frame(const SpatialVector& normal, int axis) {
  Frame frame;
  frame.normal = normal;
  if (normal.size() == 2) {
    frame.tangents = tangent(normal).transpose();
    frame.turn[0] = (SpatialMatrix(2, 2) << 0.0, -1.0, 1.0, 0.0).finished();
    return frame;
  }
  const Eigen::Vector3d n = normal, e = Eigen::Vector3d::Unit(axis), s = e - n[axis] * n, first = s.normalized(), second = n.cross(first);
  const auto cross_matrix = [](const Eigen::Vector3d& v) {
    return (Eigen::Matrix3d() << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0).finished();
  };
  // ds = -(e . dn) n - (e . n) dn,  d tau_1 = (I - tau_1 tau_1^T) ds / |s|,  d tau_2 = dn x tau_1 + n x d tau_1
  const Eigen::Matrix3d ds = -n * e.transpose() - n[axis] * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d turn = (Eigen::Matrix3d::Identity() - first * first.transpose()) * ds / s.norm();
  frame.tangents.resize(2, 3);
  frame.tangents << first.transpose(), second.transpose();
  frame.turn = {turn, -cross_matrix(first) + cross_matrix(n) * turn};
  return frame;
}

/// The coordinate axis that is furthest from parallel to n.
inline int transverse_axis(const SpatialVector& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  return static_cast<int>(axis);
}

}  // namespace mortise
