#include "mortise/contact/frame.hpp"

#include <Eigen/Geometry>

namespace mortise {

Eigen::Vector2d tangent(const Eigen::Vector2d& normal) { return {-normal.y(), normal.x()}; }

Frame make_frame(const SpatialVector& normal, int axis) {
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

int transverse_axis(const SpatialVector& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  return static_cast<int>(axis);
}

}  // namespace mortise
