#pragma once
// Contact conditions with a stiffness: penalty, and one Newton solve of the augmented Lagrange method.

#include "mortise/contact/complementarity.hpp"

namespace mortise {

/// What a regularised condition starts from and how stiff it is.
struct RegularisedNode {
  double normal_stiffness = 0.0;      ///< eps_n [traction / length]
  double tangential_stiffness = 0.0;  ///< eps_t [traction / length]
  double body_stiffness = 0.0;        ///< c, of what the node hangs on where it is covered wholly [traction / length]
  double full_weight = 1.0;           ///< A, its share of the surface where it is covered wholly
  SpatialVector multiplier;           ///< (lambda_n, lambda_tau) in the node's frame: held fixed
};

/// Adds to `law`, the normal condition C_n = z_n - p of a node, the rows of friction with a stiffness:
///   C_tau = z_tau - Pi_rho(y),   y = (1 - theta_t) z_tau + theta_t (lambda_tau + eps_t u / w),   rho at p
/// @param pressure  p, whose derivatives are dp = dz_n - dC_n
template <class Bound>
void add_regularised_friction(Complementarity& law, double pressure, const RegularisedNode& node, const TangentVector& slip, double weight,
                              const Frame& frame, const SpatialVector& z, const Bound& bound) {
  const Eigen::Index tangents = frame.tangents.rows();
  const double body = node.body_stiffness * weight, theta_t = body / (body + node.tangential_stiffness * node.full_weight);
  const double stiffness = theta_t * node.tangential_stiffness / weight;
  const TangentVector beyond = law.C.tail(tangents) - node.multiplier.tail(tangents);  // z_tau - lambda_tau
  const TangentVector y = node.multiplier.tail(tangents) + (1.0 - theta_t) * beyond + stiffness * slip;
  const FrictionBound limit = bound(pressure);
  // dC_tau = dz_tau - response dy - slope dp,   dy = (1 - theta_t) dz_tau + stiffness du - theta_t / w ((1 - theta_t) (z_tau - lambda_tau) +
  // stiffness u) dw
  TangentMatrix response = TangentMatrix::Identity(tangents, tangents);
  TangentVector slope = TangentVector::Zero(tangents);
  if (y.norm() < at_the_bound * limit.value) {
    law.state = ContactState::stick;
    law.C.tail(tangents) -= y;
  } else {
    const SlipDirection direction(y, limit.value);
    response = direction.turning;
    slope = limit.slope * direction.along;
    law.C.tail(tangents) -= direction.length * direction.along;
  }
  const TangentMatrix of_traction = TangentMatrix::Identity(tangents, tangents) - (1.0 - theta_t) * response;
  const SpatialVector p_z = frame.normal - law.C_z.row(0).transpose(), p_normal = z - law.normal_factor.row(0).transpose();
  law.C_z.bottomRows(tangents) = of_traction * frame.tangents - slope * p_z.transpose();
  law.normal_factor.bottomRows(tangents) = of_traction * SpatialMatrix(law.normal_factor.bottomRows(tangents)) - slope * p_normal.transpose();
  law.gap_factor.tail(tangents) = law.gap_factor[0] * slope;
  law.slip_factor = -stiffness * response;
  law.weight_factor.tail(tangents) = theta_t / weight * (response * ((1.0 - theta_t) * beyond + stiffness * slip)) + law.weight_factor[0] * slope;
}

/// C of a node whose tractions follow from averages over its share w = sum_k D_jk of the surface: g / w of the gap and u / w of the slip,
///   z_n = max(0, lambda_n - eps_n g / w),   z_tau = Pi_rho(lambda_tau + eps_t u / w).
/// Pi_rho is the projection on the ball of radius rho, the bound at z_n (Simo, Laursen 1992). What stands in max and Pi_rho tells states apart. With
/// z itself weighed in, it does so as the exact conditions do, and the solution is the same:
///   p = (1 - theta_n) z_n + theta_n (lambda_n - eps_n g / w)         open (C = z) unless p > 0,  C_n = z_n - p
///   y = (1 - theta_t) z_tau + theta_t (lambda_tau + eps_t u / w)     C_tau = z_tau - Pi_rho(y),  rho at p
/// Here theta = c w / (c w + eps A) (docs/formulations.md says why not 1; Sitzmann, Willner, Wohlmuth 2015). A node that is covered in part moves by
/// its force w z_n. So theta eps / w = c eps / (c w + eps A) stays bounded with w -> 0, and a tie's part of the gap throws no node from state to
/// state.
/// @param bound  of a pressure; null: without friction, C_tau = z_tau
template <class Bound>
Complementarity regularised(const RegularisedNode& node, double gap, const TangentVector& slip, double weight, const Frame& frame,
                            const SpatialVector& z, const Bound* bound) {
  const double body = node.body_stiffness * weight;
  const double theta_n = body / (body + node.normal_stiffness * node.full_weight), normal_stiffness = theta_n * node.normal_stiffness / weight;
  const double z_n = z.dot(frame.normal), pressure = (1.0 - theta_n) * z_n + theta_n * node.multiplier[0] - normal_stiffness * gap;
  if (!(pressure > 0.0)) return open_node(z);
  // dp = (1 - theta_n) dz_n - normal_stiffness dg - theta_n / w ((1 - theta_n) (z_n - lambda_n) - normal_stiffness g) dw
  Complementarity result = closed_node(normal_stiffness, gap, frame, z);
  result.C[0] = z_n - pressure;
  result.C_z.row(0) = theta_n * frame.normal.transpose();
  result.weight_factor[0] = theta_n / weight * ((1.0 - theta_n) * (z_n - node.multiplier[0]) - normal_stiffness * gap);
  result.normal_factor.row(0) = theta_n * z.transpose();
  if (bound != nullptr) add_regularised_friction(result, pressure, node, slip, weight, frame, z, *bound);
  return result;
}

/// The return map itself: (z_n, z_tau) = (max(0, lambda_n - eps_n g / w), Pi_rho(lambda_tau + eps_t u / w)), rho at that z_n. A multiplier lambda
/// that it leaves as it is fulfils the exact conditions, whatever the stiffness.
/// @param bound  of a pressure; null: without friction, lambda_tau stays
template <class Bound>
SpatialVector return_map(const RegularisedNode& node, double gap, const TangentVector& slip, double weight, const Bound* bound) {
  SpatialVector result = node.multiplier;
  const Eigen::Index tangents = result.size() - 1;
  const double pressure = node.multiplier[0] - node.normal_stiffness * gap / weight;
  if (!(pressure > 0.0)) return SpatialVector::Zero(result.size());
  result[0] = pressure;
  if (bound == nullptr) return result;
  const TangentVector y = node.multiplier.tail(tangents) + node.tangential_stiffness / weight * slip;
  const double limit = (*bound)(pressure).value, length = y.norm();
  result.tail(tangents) = length > limit ? TangentVector(limit / length * y) : y;
  return result;
}

}  // namespace mortise
