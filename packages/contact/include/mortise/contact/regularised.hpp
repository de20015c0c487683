#pragma once
// Contact conditions with a stiffness: penalty, and one Newton solve of the augmented Lagrange method.

#include "mortise/contact/complementarity.hpp"

namespace mortise {

/// Start and stiffness of a regularised condition.
struct RegularisedNode {
  double normal_stiffness = 0.0;      ///< eps_n [traction / length]
  double tangential_stiffness = 0.0;  ///< eps_t [traction / length]
  double body_stiffness = 0.0;        ///< c, of what the node hangs on where it is covered wholly [traction / length]
  double full_weight = 1.0;           ///< A, its share of the surface where it is covered wholly
  SpatialVector multiplier;           ///< (lambda_n, lambda_tau) in the node's frame: held fixed
  double start = 0.0;                 ///< g0 >= 0, weighted: the gap when the step began, to where the node bears pressure; 0: it was closed
};

/// Depth with which a node's pressure grows, beyond where it bears none: a penetration, or the pressure itself. Of a node that closed a gap.
struct NodeDepth {
  double value = 0.0;       ///< delta > 0
  double of_length = 1.0;   ///< the gap G0 = of_length g0 / w that it closed first, in the unit of delta
  SpatialVector of_z;       ///< its derivative with respect to z
  SpatialVector of_normal;  ///< with respect to the node's normal
  double of_gap = 0.0;      ///< with respect to g
  double of_weight = 0.0;   ///< with respect to w
};

/// The pressure of `law`, C_n = z_n - p:  dp = dz_n - dC_n,  G0 = eps_n g0 / w.
inline NodeDepth depth_of_pressure(const Complementarity& law, double pressure, double normal_stiffness, const Frame& frame, const SpatialVector& z) {
  return {pressure,           normal_stiffness,     frame.normal - law.C_z.row(0).transpose(), z - law.normal_factor.row(0).transpose(),
          -law.gap_factor[0], -law.weight_factor[0]};
}

/// Adds to `law`, the normal condition C_n = z_n - p of a node, the rows of friction with a stiffness:
///   C_tau = z_tau - Pi_rho(y),   y = (1 - theta_t) z_tau + theta_t q (lambda_tau + eps_t u / w),   rho at p
/// q is the share of the step's motion that the node made in contact: Landing.
/// @param pressure  p, whose derivatives are dp = dz_n - dC_n
template <class Bound>
void add_regularised_friction(Complementarity& law, double pressure, const NodeDepth& depth, const RegularisedNode& node, const TangentVector& slip,
                              double weight, const Frame& frame, const SpatialVector& z, const Bound& bound) {
  const Eigen::Index tangents = frame.tangents.rows();
  const double body = node.body_stiffness * weight, theta_t = body / (body + node.tangential_stiffness * node.full_weight);
  const double G0 = depth.of_length * node.start / weight;
  const Landing landing(depth.value, G0);
  const double stiffness = theta_t * landing.share * node.tangential_stiffness / weight;
  const TangentVector t = law.C.tail(tangents), start = node.multiplier.tail(tangents), trial = start + node.tangential_stiffness / weight * slip;
  const TangentVector y = (1.0 - theta_t) * t + theta_t * landing.share * trial;
  const FrictionBound limit = bound(pressure);
  // dC_tau = dz_tau - response dy - slope dp,   dy = (1 - theta_t) dz_tau + stiffness du + theta_t trial dq
  //                                                 + theta_t / w ((1 - theta_t) (q trial - z_tau) - q eps_t u / w) dw
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
  law.weight_factor.tail(tangents) =
      -theta_t / weight * (response * ((1.0 - theta_t) * (landing.share * trial - t) - landing.share * (trial - start))) +
      law.weight_factor[0] * slope;
  if (!(G0 > 0.0)) return;
  // dq = of_depth d delta + of_start dG0,   dG0 = of_length dg0 / w - G0 dw / w
  const TangentVector of_share = -theta_t * (response * trial);
  law.C_z.bottomRows(tangents) += landing.of_depth * of_share * depth.of_z.transpose();
  law.normal_factor.bottomRows(tangents) += landing.of_depth * of_share * depth.of_normal.transpose();
  law.gap_factor.tail(tangents) += landing.of_depth * depth.of_gap * of_share;
  law.weight_factor.tail(tangents) += (landing.of_depth * depth.of_weight - landing.of_start * G0 / weight) * of_share;
  law.start_factor = landing.of_start * depth.of_length / weight * of_share;
}

/// C of a node whose tractions follow from averages over its share w = sum_k D_jk of the surface, g / w of the gap and u / w of the slip:
///   z_n = max(0, lambda_n - eps_n g / w),   z_tau = Pi_rho(q (lambda_tau + eps_t u / w)).
/// Pi_rho is the projection on the ball of radius rho, the bound at z_n (Simo, Laursen 1992). The arguments of max and Pi_rho decide on the state.
/// With a share of z itself in them they do so as the exact conditions do, and the solution is the same. Then
///   p = (1 - theta_n) z_n + theta_n (lambda_n - eps_n g / w)         open (C = z) unless p > 0,  C_n = z_n - p
///   y = (1 - theta_t) z_tau + theta_t q (lambda_tau + eps_t u / w)   C_tau = z_tau - Pi_rho(y),  rho at p
/// q = 1, but for a node that closed a gap in this step: the share of its motion from first contact on,  q = p / (p + eps_n g0 / w).
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
  if (bound != nullptr)
    add_regularised_friction(result, pressure, depth_of_pressure(result, pressure, node.normal_stiffness, frame, z), node, slip, weight, frame, z,
                             *bound);
  return result;
}

/// The return map itself: (z_n, z_tau) = (max(0, lambda_n - eps_n g / w), Pi_rho(q (lambda_tau + eps_t u / w))), rho and q at that z_n. A multiplier
/// lambda that it leaves as it is fulfils the exact conditions, whatever the stiffness.
/// @param bound  of a pressure; null: without friction, lambda_tau stays
template <class Bound>
SpatialVector return_map(const RegularisedNode& node, double gap, const TangentVector& slip, double weight, const Bound* bound) {
  SpatialVector result = node.multiplier;
  const Eigen::Index tangents = result.size() - 1;
  const double pressure = node.multiplier[0] - node.normal_stiffness * gap / weight;
  if (!(pressure > 0.0)) return SpatialVector::Zero(result.size());
  result[0] = pressure;
  if (bound == nullptr) return result;
  const double share = Landing(pressure, node.normal_stiffness * node.start / weight).share;
  const TangentVector y = share * (node.multiplier.tail(tangents) + node.tangential_stiffness / weight * slip);
  const double limit = (*bound)(pressure).value, length = y.norm();
  result.tail(tangents) = length > limit ? TangentVector(limit / length * y) : y;
  return result;
}

}  // namespace mortise
