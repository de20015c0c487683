#pragma once
// The complementarity function of a slave node, with and without friction, and its derivatives.

#include <Eigen/Core>
#include <cmath>

#include "mortise/contact/frame.hpp"
#include "mortise/contact/friction.hpp"

namespace mortise {

/// What a slave node does. A closed node without friction slips.
enum class ContactState { open = 0, stick = 1, slip = 2 };

/// C of one node in its frame (n, tau_a), rows in units of traction, and its linearisation
///   dC = C_z dz + gap_factor dg + weight_factor dw + normal_factor dn + [ 0 ; slip_factor du ],   w = sum_k D_jk.
struct Complementarity {
  ContactState state = ContactState::open;
  SpatialVector C;
  SpatialMatrix C_z;
  SpatialVector gap_factor;
  SpatialVector weight_factor;  ///< 0 but for regularised conditions
  SpatialMatrix normal_factor;
  TangentMatrix slip_factor;  ///< without size: slips do not matter
};

/// C of an open node:  C = z.
inline Complementarity open_node(const SpatialVector& z) {
  const Eigen::Index dimension = z.size();
  Complementarity result;
  result.C = z;
  result.C_z = SpatialMatrix::Identity(dimension, dimension);
  result.gap_factor = result.weight_factor = SpatialVector::Zero(dimension);
  result.normal_factor = SpatialMatrix::Zero(dimension, dimension);
  return result;
}

/// C of a closed node (z . n - c_n g > 0) without friction:  C_n = c_n g,  C_a = z . tau_a.
/// @param c_n  complementarity constant, traction per weighted gap
inline Complementarity closed_node(double c_n, double gap, const Frame& frame, const SpatialVector& z) {
  const Eigen::Index tangents = frame.tangents.rows();
  Complementarity result = open_node(z);
  result.state = ContactState::slip;
  result.C[0] = c_n * gap;
  result.C.tail(tangents) = frame.tangents * z;
  result.C_z.row(0).setZero();
  result.C_z.bottomRows(tangents) = frame.tangents;
  result.gap_factor[0] = c_n;
  for (Eigen::Index a = 0; a < tangents; ++a) result.normal_factor.row(1 + a) = z.transpose() * frame.turn[a];
  return result;
}

/// The direction e = y / |y| of slip and how the bound's share of the traction turns with y:  d(rho e) = e drho + turning dy.
struct SlipDirection {
  TangentVector along;
  double length = 0.0;    ///< of the projection of y on the ball of radius rho; NaN with rho
  TangentMatrix turning;  ///< rho / |y| (I - e e^T); 0 in 2D
  SlipDirection(const TangentVector& y, double bound) : along(TangentVector::Zero(y.size())), turning(TangentMatrix::Zero(y.size(), y.size())) {
    const double norm = y.norm();
    length = norm < bound ? norm : bound;
    if (!(norm > 0.0)) return;
    along = y / norm;
    if (y.size() > 1) turning = bound / norm * (TangentMatrix::Identity(2, 2) - along * along.transpose());
  }
};

/// Share of the bound from which on a node counts as slipping. Where |y| = rho both derivatives of C are valid. A node that slipped in the last step
/// starts the next one there, up to what Newton's tolerance and round-off leave. These are not to choose for each node anew.
inline constexpr double at_the_bound = 1.0 - 1e-9;

/// Distance beyond the bound, in c_t |u|, up to which a node in 3D that slips against its traction sticks. Newton leaves the traction of a slipping
/// node on a tangent of the circle |t| = rho. After a turn by theta |t| = rho / cos(theta), which is no sign that it slips on.
inline constexpr double against_the_traction = 10.0;

/// @param t      shear traction
/// @param cu     c_t u
/// @param bound  rho
inline bool sticks(const TangentVector& t, const TangentVector& cu, double bound) {
  if ((t + cu).norm() < at_the_bound * bound) return true;
  const double length = t.norm();
  return t.size() > 1 && length > bound && cu.norm() < bound && length * (length - bound) < -against_the_traction * t.dot(cu);
}

/// C of a closed node with friction (Hueber, Wohlmuth 2005; Gitterle et al. 2010, with all rows in units of traction). With y = z_tau + c_t u and the
/// bound rho at the pressure z_n - c_n g:
///   stick   |y| < rho   C_tau = -c_t u
///   slip                C_tau = z_tau - rho y / |y|
/// In 3D a node whose slip is against its traction sticks too: 0 < |t| - rho < -10 c_t u . t / |t| with t = z_tau and c_t |u| < rho. Then
/// |t| - rho < 10 |C_tau|, so C vanishes where it did. Just below the bound (at_the_bound) it is C of stick with the derivative of slip.
/// @param slip  weighted slip u of the step: the slave's motion relative to the master along tau_a, times the weight
inline Complementarity with_friction(double c_n, double c_t, double gap, const TangentVector& slip, const Frame& frame, const SpatialVector& z,
                                     const FrictionBound& bound) {
  const Eigen::Index tangents = slip.size();
  Complementarity result = closed_node(c_n, gap, frame, z);
  const TangentVector t = result.C.tail(tangents), cu = c_t * slip;
  if (sticks(t, cu, bound.value)) {
    result.state = ContactState::stick;
    result.C.tail(tangents) = -cu;
    result.C_z.bottomRows(tangents).setZero();
    result.normal_factor.bottomRows(tangents).setZero();
    result.slip_factor = -c_t * TangentMatrix::Identity(tangents, tangents);
    return result;
  }
  const SlipDirection direction(t + cu, bound.value);
  const TangentVector slope = bound.slope * direction.along;
  result.C.tail(tangents) -= direction.length * direction.along;
  if (tangents > 1) {
    result.C_z.bottomRows(tangents) -= direction.turning * frame.tangents;
    result.normal_factor.bottomRows(tangents) -= direction.turning * SpatialMatrix(result.normal_factor.bottomRows(tangents));
    result.slip_factor = -c_t * direction.turning;
  }
  result.C_z.bottomRows(tangents) -= slope * frame.normal.transpose();
  result.normal_factor.bottomRows(tangents) -= slope * z.transpose();
  result.gap_factor.tail(tangents) = c_n * slope;
  return result;
}

/// `law` with z . tau_a = 0 in the place of what it asks along tangent a: nothing moves there, and no shear traction is borne.
inline void hold_tangent(Complementarity& law, const Frame& frame, const SpatialVector& z, Eigen::Index a) {
  law.C[1 + a] = frame.tangents.row(a).dot(z);
  law.C_z.row(1 + a) = frame.tangents.row(a);
  law.normal_factor.row(1 + a) = z.transpose() * frame.turn[a];
  law.gap_factor[1 + a] = law.weight_factor[1 + a] = 0.0;
  if (law.slip_factor.size() == 0) return;
  law.slip_factor.row(a).setZero();
  law.slip_factor.col(a).setZero();
}

}  // namespace mortise
