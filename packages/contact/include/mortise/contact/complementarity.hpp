#pragma once
// The complementarity function of a slave node, with and without friction, and its derivatives.

#include <Eigen/Core>
#include <cmath>

#include "mortise/contact/friction.hpp"

namespace mortise {

/// What a slave node does. A closed node without friction slips.
enum class ContactState { open = 0, stick = 1, slip = 2 };

/// C of one node in the frame (n, tau), rows in units of traction, and its linearisation
///   dC = C_z dz + gap_factor dg + weight_factor dw + normal_factor dn + [ 0 ; slip_factor du ],   w = sum_k D_jk.
struct Complementarity {
  ContactState state = ContactState::open;
  Eigen::Vector2d C = Eigen::Vector2d::Zero();
  Eigen::Matrix2d C_z = Eigen::Matrix2d::Identity();
  Eigen::Vector2d gap_factor = Eigen::Vector2d::Zero();
  Eigen::Vector2d weight_factor = Eigen::Vector2d::Zero();  ///< 0 but for regularised conditions
  Eigen::Matrix2d normal_factor = Eigen::Matrix2d::Zero();
  double slip_factor = 0.0;
};

/// Tangent of a normal in 2D: n turned by +90 degrees.
inline Eigen::Vector2d tangent(const Eigen::Vector2d& normal) { return {-normal.y(), normal.x()}; }

/// C of a node without friction:
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
  result.state = ContactState::slip;
  result.C = {c_n * gap, z.dot(tau)};
  result.C_z << 0.0, 0.0, tau.x(), tau.y();
  result.gap_factor = {c_n, 0.0};
  // z . d(tau) = z . (-dn_y, dn_x)
  result.normal_factor.row(1) << z.y(), -z.x();
  return result;
}

/// C of a closed node with friction (Hueber, Wohlmuth 2005; Gitterle et al. 2010, with all rows in units of traction). With y = z_tau + c_t u and the
/// bound rho at the pressure z_n - c_n g:
///   stick   |y| < rho   C_tau = -c_t u
///   slip                C_tau = z_tau - rho sign(y)
/// @param slip  weighted slip u of the step: the slave's motion relative to the master along tau, times the weight
inline Complementarity with_friction(double c_n, double c_t, double gap, double slip, const Eigen::Vector2d& normal, const Eigen::Vector2d& z,
                                     const FrictionBound& bound) {
  Complementarity result = frictionless(true, c_n, gap, normal, z);
  const double y = result.C[1] + c_t * slip;
  if (std::abs(y) < bound.value) {
    result.state = ContactState::stick;
    result.C[1] = -c_t * slip;
    result.C_z.row(1).setZero();
    result.normal_factor.row(1).setZero();
    result.slip_factor = -c_t;
    return result;
  }
  const double sign = y > 0.0 ? 1.0 : y < 0.0 ? -1.0 : 0.0, slope = sign * bound.slope;
  result.C[1] -= sign * bound.value;
  result.C_z.row(1) -= slope * normal.transpose();
  result.normal_factor.row(1) -= slope * z.transpose();
  result.gap_factor[1] = slope * c_n;
  return result;
}

}  // namespace mortise
