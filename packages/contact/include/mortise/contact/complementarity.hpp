#pragma once
// The complementarity function of a slave node, with and without friction, and its derivatives.

#include "mortise/contact/contact_state.hpp"
#include "mortise/contact/frame.hpp"
#include "mortise/contact/friction_bound.hpp"

namespace mortise {

/// C of one node in its frame (n, tau_a), rows in units of traction, and its linearisation with the weight w = sum_k D_jk:
///   dC = C_z dz + gap_factor dg + weight_factor dw + normal_factor dn + [ 0 ; slip_factor du + start_factor dg0 ].
struct Complementarity {
  ContactState state = ContactState::open;  ///< state of the node by C
  SpatialVector C;                          ///< rows n, tau_a; 0 where the conditions are met
  SpatialMatrix C_z;                        ///< dC/dz
  SpatialVector gap_factor;                 ///< dC/dg
  SpatialVector weight_factor;              ///< 0 but for regularised conditions
  SpatialMatrix normal_factor;              ///< dC/dn
  TangentMatrix slip_factor;                ///< without size: slips do not matter
  TangentVector start_factor;               ///< of the gap at the start of the step; without size: it does not matter
};

/// C of an open node:  C = z.
Complementarity open_node(const SpatialVector& z);

/// C of a closed node (z . n - c_n g > 0) without friction:  C_n = c_n g,  C_a = z . tau_a.
/// @param c_n  complementarity constant, traction per weighted gap
Complementarity closed_node(double c_n, double gap, const Frame& frame, const SpatialVector& z);

/// The direction e = y / |y| of slip and how the bound's share of the traction turns with y:  d(rho e) = e drho + turning dy.
struct SlipDirection {
  TangentVector along;    ///< e
  double length = 0.0;    ///< of the projection of y on the ball of radius rho; NaN with rho
  TangentMatrix turning;  ///< rho / |y| (I - e e^T); 0 in 2D
  /// Of the traction y that the node would bear if it stuck, at the bound rho.
  SlipDirection(const TangentVector& y, double bound);
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
bool sticks(const TangentVector& t, const TangentVector& cu, double bound);

/// Share q of the motion of a step that a node makes in contact. It began at a gap G0 > 0 before that and has come to the depth delta
/// behind it. Both move on a straight line in the step, so  q = delta / (delta + G0),  and 1 without a gap.
struct Landing {
  double share = 1.0;     ///< q
  double of_depth = 0.0;  ///< dq / d delta
  double of_start = 0.0;  ///< dq / dG0
  Landing() = default;    ///< without a gap
  /// @param depth  delta > 0
  Landing(double depth, double start);
};

/// The first tangents of a node along which its displacement is prescribed. Its momentum along them holds an unknown reaction, so that the traction
/// there follows from its law. A node that sticks is a spring, whose give is taken out of the slip.
struct HeldTangents {
  Eigen::Index count = 0;   ///< number of them; 0: none
  TangentVector traction;   ///< z_tau when the step began, 0 beyond the first `count`; without size if there are none
  double compliance = 1.0;  ///< e in (0, 1]: of the spring that a node that sticks has along them, in slip per traction over 1 / c_t
};

/// C of a closed node with friction (Hueber, Wohlmuth 2005; Gitterle et al. 2010, with all rows in units of traction). Let y = z_tau + c_t u and rho
/// be the bound at the pressure z_n - c_n g. Then for the two states:
///   Stick   |y| < rho   C_tau = -c_t u
///   Slip                C_tau = z_tau - rho y / |y|
/// In 3D a node whose slip is against its traction sticks too: 0 < |t| - rho < -10 c_t u . t / |t| with t = z_tau and c_t |u| < rho. Then
/// |t| - rho < 10 |C_tau|, so C vanishes where it did. Just below the bound (at_the_bound) it is C of stick with the derivative of slip.
///
/// A node that closed the gap g0 in this step slips from the moment of first contact on. With the pressure p = z_n - c_n g, which is c_n times a
/// depth,
///   y = q (z_tau + c_t u),   q = p / (p + c_n g0),   stick   C_tau = z_tau - y.
/// With c_t = c_n its traction then is  p u / g0  if friction bears that, whatever c is: it lies along the way on which the node came. A node that
/// comes from within the cone of friction sticks.
///
/// Along tangents that are held a node that sticks gives by e (z_tau - z_tau^old) / c_t. That is no slip, as an elastic strain is no plastic one:
///   y = q (z_tau + c_t u - e (z_tau - z_tau^old)),   and stick too is   C_tau = z_tau - y.
/// @param slip   weighted slip u of the step: the slave's motion relative to the master along tau_a, times the weight
/// @param start  g0 >= 0, the weighted gap that the node had when the step began; 0 for one that was closed
Complementarity with_friction(double c_n, double c_t, double gap, const TangentVector& slip, const Frame& frame, const SpatialVector& z,
                              const FrictionBound& bound, double start = 0.0, const HeldTangents& held = {});

}  // namespace mortise
