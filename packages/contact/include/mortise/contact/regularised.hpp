#pragma once
// Contact conditions with a stiffness: penalty, and one Newton solve of the augmented Lagrange method.

#include "mortise/contact/complementarity.hpp"

namespace mortise {

/// What a regularised condition starts from and how stiff it is.
struct RegularisedNode {
  double normal_stiffness = 0.0, tangential_stiffness = 0.0;  ///< eps_n, eps_t [traction / length]
  SpatialVector multiplier;                                   ///< (lambda_n, lambda_tau) in the node's frame: held fixed
};

/// C of a node whose tractions follow from the averages g / w of the gap and u / w of the slip over its share w = sum_k D_jk of the surface:
///   p = lambda_n - eps_n g / w,   open (C = z) unless p > 0
///   C_n = z_n - p,   C_tau = z_tau - Pi_rho(y),   y = lambda_tau + eps_t u / w,   Pi_rho the projection on the ball of radius rho, the bound at p
/// (Simo, Laursen 1992). So z is a function of the displacements.
/// @param bound  of a pressure; null: without friction, C_tau = z_tau
template <class Bound>
Complementarity regularised(const RegularisedNode& node, double gap, const TangentVector& slip, double weight, const Frame& frame,
                            const SpatialVector& z, const Bound* bound) {
  const double pressure = node.multiplier[0] - node.normal_stiffness * gap / weight;
  if (!(pressure > 0.0)) return open_node(z);
  const Eigen::Index tangents = frame.tangents.rows();
  const double gap_slope = -node.normal_stiffness / weight, weight_slope = node.normal_stiffness * gap / (weight * weight);  // of the pressure
  Complementarity result = closed_node(0.0, gap, frame, z);
  result.C[0] = z.dot(frame.normal) - pressure;
  result.C_z.row(0) = frame.normal.transpose();
  result.gap_factor[0] = -gap_slope;
  result.weight_factor[0] = -weight_slope;
  result.normal_factor.row(0) = z.transpose();
  if (bound == nullptr) return result;
  const double stiffness = node.tangential_stiffness / weight;  // dy = stiffness (du - u dw / w)
  const TangentVector y = node.multiplier.tail(tangents) + stiffness * slip;
  const FrictionBound limit = (*bound)(pressure);
  if (y.norm() < limit.value) {
    result.state = ContactState::stick;
    result.C.tail(tangents) -= y;
    result.slip_factor = -stiffness * TangentMatrix::Identity(tangents, tangents);
    result.weight_factor.tail(tangents) = stiffness / weight * slip;
    return result;
  }
  const SlipDirection direction(y, limit.value);
  result.C.tail(tangents) -= limit.value * direction.along;
  result.gap_factor.tail(tangents) = -limit.slope * gap_slope * direction.along;
  result.weight_factor.tail(tangents) = -limit.slope * weight_slope * direction.along;
  if (tangents > 1) {
    result.slip_factor = -stiffness * direction.turning;
    result.weight_factor.tail(tangents) += stiffness / weight * (direction.turning * slip);
  }
  return result;
}

}  // namespace mortise
