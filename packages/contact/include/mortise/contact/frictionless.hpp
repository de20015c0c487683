#pragma once
// The complementarity function of a slave node without friction, and its derivatives.

#include <Eigen/Core>

namespace mortise {

/// C of one node in the frame (n, tau), and its linearisation
///   dC = C_z dz + [ gap_factor dg ; normal_factor . dn ].
struct Complementarity {
  Eigen::Vector2d C = Eigen::Vector2d::Zero();
  Eigen::Matrix2d C_z = Eigen::Matrix2d::Identity();
  double gap_factor = 0.0;
  Eigen::Vector2d normal_factor = Eigen::Vector2d::Zero();
};

/// Tangent of a normal in 2D: n turned by +90 degrees.
inline Eigen::Vector2d tangent(const Eigen::Vector2d& normal) { return {-normal.y(), normal.x()}; }

/// C of a node without friction, rows in units of traction:
///   open     C = z
///   closed   C_n = c_n g,   C_tau = z . tau
/// @param closed  whether z . n - c_n g > 0
/// @param c_n     complementarity constant, traction per weighted gap
inline Complementarity frictionless(bool closed, double c_n, double gap, const Eigen::Vector2d& normal, const Eigen::Vector2d& z) {
  Complementarity result;
  if (!closed) {
    result.C = z;
    return result;
  }
  const Eigen::Vector2d tau = tangent(normal);
  result.C = {c_n * gap, z.dot(tau)};
  result.C_z << 0.0, 0.0, tau.x(), tau.y();
  result.gap_factor = c_n;
  // z . d(tau) = z . (-dn_y, dn_x)
  result.normal_factor = {z.y(), -z.x()};
  return result;
}

}  // namespace mortise
