#pragma once
// Isotropic laws in logarithmic strain: what Hencky's elasticity and plasticity that builds on it share.

#include <cmath>

#include "mortise/material/spectral.hpp"

namespace mortise {

/// e_a = 1/2 ln b_a, the principal logarithmic strains. NaN where b_a <= 0.
inline Eigen::Vector3d logarithmic_strain(const Spectrum& b) { return 0.5 * b.values.array().log().matrix(); }

/// sum_a values(a) n_a n_a^T.
inline Matrix3 in_axes_of(const Spectrum& b, const Eigen::Vector3d& values) { return b.vectors * values.asDiagonal() * b.vectors.transpose(); }

/// (ln a - ln b) / (a - b), 1 / b for a = b. log1p keeps it exact to round-off however close a and b are.
inline double logarithm_slope(double a, double b) {
  const double x = (a - b) / b;
  return (x == 0.0 ? 1.0 : std::log1p(x) / x) / b;
}

/// The components of n_a n_c^T.
template <class Components>
Eigen::Matrix<double, Components::size, 1> dyad(const Matrix3& n, int a, int c) {
  Eigen::Matrix<double, Components::size, 1> result;
  for (int p = 0; p < Components::size; ++p) result(p) = n(Components::row[p], a) * n(Components::column[p], c);
  return result;
}

/// A (see StressAndTangent) of tau_a = lambda tr e + 2 mu e_a + const with b = F B F^T for a constant B, at the Kirchhoff stress `stress`:
/// db = L b + b L^T, so in the axes of b the normal strains change by de_a = L_aa and, off the diagonal, for an isotropic function,
///   d tau_ab = theta_ab (L_ab b_b + b_a L_ba),   theta_ab = (tau_a - tau_b) / (b_a - b_b) = mu (ln b_a - ln b_b) / (b_a - b_b).
/// The slopes may be the secant ones of a law whose deviator is parallel to that of e; what its tangent has beyond them is the caller's.
template <class Components>
Eigen::Matrix<double, Components::size, Components::size> logarithmic_tangent(const Spectrum& b, double lambda, double mu, const Matrix3& stress) {
  constexpr int size = Components::size;
  Eigen::Matrix<double, size, size> tangent;
  // sum_a n_a n_a^T = I makes lambda I x I of the volumetric part; the geometric term is - tau_il delta_jk.
  for (int q = 0; q < size; ++q)
    for (int p = 0; p < size; ++p) {
      const int i = Components::row[p], j = Components::column[p], k = Components::row[q], l = Components::column[q];
      tangent(p, q) = (i == j && k == l ? lambda : 0.0) - (j == k ? stress(i, l) : 0.0);
    }
  for (int a = 0; a < 3; ++a) {
    const auto normal = dyad<Components>(b.vectors, a, a);
    tangent.noalias() += 2.0 * mu * normal * normal.transpose();
    for (int c = 0; c < a; ++c) {
      const auto ac = dyad<Components>(b.vectors, a, c), ca = dyad<Components>(b.vectors, c, a);
      const double theta = mu * logarithm_slope(b.values(a), b.values(c));
      tangent.noalias() += theta * (ac + ca) * (b.values(c) * ac + b.values(a) * ca).transpose();
    }
  }
  return tangent;
}

}  // namespace mortise
