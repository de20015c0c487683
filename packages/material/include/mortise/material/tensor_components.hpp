#pragma once
// Components (i, j) of second order tensors for which a tangent is wanted, and the tangent in these components.

#include <Eigen/Core>

namespace mortise {

using Matrix3 = Eigen::Matrix3d;

/// The in-plane components 11, 12, 21, 22: plane strain and plane stress.
struct PlaneComponents {
  static constexpr int size = 4;
  static constexpr int row[size] = {0, 0, 1, 1};
  static constexpr int column[size] = {0, 1, 0, 1};
};

/// The in-plane components and 33, the hoop: axisymmetric.
struct AxisymmetricComponents {
  static constexpr int size = 5;
  static constexpr int row[size] = {0, 0, 1, 1, 2};
  static constexpr int column[size] = {0, 1, 0, 1, 2};
};

/// All components.
struct SolidComponents {
  static constexpr int size = 9;
  static constexpr int row[size] = {0, 0, 0, 1, 1, 1, 2, 2, 2};
  static constexpr int column[size] = {0, 1, 2, 0, 1, 2, 0, 1, 2};
};

/// Results of a law for one deformation gradient F.
/// `stress`: the Kirchhoff stress tau, units of stress. `tangent(p, q)` = A_ijkl, p = (i, j), q = (k, l) of Components:
///   A_ijkl = d tau_ij / dF_km F_lm - tau_il delta_jk,
/// so that for a change of F by dF = L F   A : L = d tau - tau L^T, and the virtual work tau : grad eta changes by grad eta : A : L.
template <class Components>
struct StressAndTangent {
  Matrix3 stress;
  Eigen::Matrix<double, Components::size, Components::size> tangent;
};

}  // namespace mortise
