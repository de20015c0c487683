#pragma once
// Contact conditions with a stiffness: penalty, and one Newton solve of the augmented Lagrange method.

#include "mortise/contact/complementarity.hpp"

namespace mortise {

/// What a regularised condition starts from and how stiff it is.
struct RegularisedNode {
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;  ///< eps_n, eps_t [traction / length]
  Eigen::Vector2d multiplier = Eigen::Vector2d::Zero();       ///< (lambda_n, lambda_tau): held fixed
};

/// C of a node whose tractions follow from the averages g / w of the gap and u / w of the slip over its share w = sum_k D_jk of the surface:
///   p = lambda_n - eps_n g / w,   open (C = z) unless p > 0
///   C_n = z_n - p,   C_tau = z_tau - Pi_rho(lambda_tau + eps_t u / w),   Pi_rho the projection on [-rho, rho], rho the bound at p
/// (Simo, Laursen 1992). So z is a function of the displacements.
/// @param bound  of a pressure; null: without friction, C_tau = z_tau
template <class Bound>
Complementarity regularised(const RegularisedNode& node, double gap, double slip, double weight, const Eigen::Vector2d& normal,
                            const Eigen::Vector2d& z, const Bound* bound) {
  Complementarity result;
  const double pressure = node.multiplier[0] - node.normal_stiffness * gap / weight;
  if (!(pressure > 0.0)) {
    result.C = z;
    return result;
  }
  const Eigen::Vector2d tau = tangent(normal);
  const double gap_slope = -node.normal_stiffness / weight, weight_slope = node.normal_stiffness * gap / (weight * weight);  // of the pressure
  result.state = ContactState::slip;
  result.C = {z.dot(normal) - pressure, z.dot(tau)};
  result.C_z.row(0) = normal.transpose();
  result.C_z.row(1) = tau.transpose();
  result.gap_factor = {-gap_slope, 0.0};
  result.weight_factor = {-weight_slope, 0.0};
  result.normal_factor.row(0) = z.transpose();
  result.normal_factor.row(1) << z.y(), -z.x();
  if (bound == nullptr) return result;
  const double trial = node.multiplier[1] + node.tangential_stiffness * slip / weight;
  const FrictionBound limit = (*bound)(pressure);
  if (std::abs(trial) < limit.value) {
    result.state = ContactState::stick;
    result.C[1] -= trial;
    result.slip_factor = -node.tangential_stiffness / weight;
    result.weight_factor[1] = node.tangential_stiffness * slip / (weight * weight);
    return result;
  }
  const double sign = trial > 0.0 ? 1.0 : trial < 0.0 ? -1.0 : 0.0;
  result.C[1] -= sign * limit.value;
  result.gap_factor[1] = -sign * limit.slope * gap_slope;
  result.weight_factor[1] = -sign * limit.slope * weight_slope;
  return result;
}

}  // namespace mortise
