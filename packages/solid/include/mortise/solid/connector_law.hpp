#pragma once
// Laws of springs and dashpots: a force between two points, or on one point against the ground.

#include <Eigen/Core>

namespace mortise {

/// Force of a spring or a dashpot and its derivatives. With e the displacement of the second point relative to the first, and e' its rate, r = f(e,
/// e') enters the residual at the second point, and -f at the first one.
struct ConnectorForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();        ///< f
  Eigen::Matrix3d by_motion = Eigen::Matrix3d::Zero();    ///< df/de
  Eigen::Matrix3d by_velocity = Eigen::Matrix3d::Zero();  ///< df/de'
  double energy = 0.0;                                    ///< stored by a spring; 0 of a dashpot
  double along = 0.0;                                     ///< force along the line between the points, above 0 in tension; 0 of components
  double elongation = 0.0;                                ///< along that line, over the length without force; 0 of components
};

/// Coefficients of a spring or a dashpot, either of fixed components or along the line between its points.
struct ConnectorLaw {
  Eigen::Vector3d components = Eigen::Vector3d::Zero();  ///< [force / length], of dashpots [force time / length]
  bool is_axial = false;                                 ///< then `axial` counts instead of `components`
  double axial = 0.0;                                    ///< likewise
  double rest_length = 0.0;                              ///< [length] of an axial spring without force

  /// f = K e, or with l = |X + e| and n = (X + e) / l
  ///     f = k (l - L) n,   df/de = k n n^T + k (1 - L / l) (I - n n^T),   W = k (l - L)^2 / 2.
  /// @param start  X, the second point less the first one before anything moves
  ConnectorForce spring(const Eigen::Vector3d& start, const Eigen::Vector3d& motion) const;

  /// f = C e', or with l and n as above
  ///     f = c (n . e') n,   df/de' = c n n^T,   df/de = c ((n . e') P + n (P e')^T) / l,   P = I - n n^T.
  ConnectorForce dashpot(const Eigen::Vector3d& start, const Eigen::Vector3d& motion, const Eigen::Vector3d& velocity) const;
};

}  // namespace mortise
