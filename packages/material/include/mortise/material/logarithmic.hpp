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

/// logarithmic_tangent() for all components, through the part c of A_ijkl = c_ijkl + delta_ik tau_jl that is symmetric in ij and in kl. With M_a =
/// n_a n_a^T, S_ac = n_a n_c^T + n_c n_a^T, and L the change of F,
///   dtau - L tau - tau L^T = c : L,   c = lambda I x I + sum_a (2 mu - 2 tau_a) M_a x M_a + sum_{a > c} (theta_ac b_c - tau_c) S_ac x S_ac.
inline Eigen::Matrix<double, 9, 9> logarithmic_tangent_in_space(const Spectrum& b, double lambda, double mu, const Matrix3& stress) {
  constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  constexpr int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};  // of the component ij in the six
  const Matrix3& n = b.vectors;
  const Matrix3 stress_on_axes = stress * n;
  Eigen::Matrix<double, 6, 6> bases, weighted;  // M_1, M_2, M_3, S_21, S_31, S_32
  for (int a = 0; a < 3; ++a) {
    const double weight = 2.0 * mu - 2.0 * n.col(a).dot(stress_on_axes.col(a));
    for (int p = 0; p < 6; ++p) bases(p, a) = n(row[p], a) * n(column[p], a);
    weighted.col(a) = weight * bases.col(a);
    for (int c = 0; c < a; ++c) {
      const int pair = 2 + a + c;
      const double theta = mu * logarithm_slope(b.values(a), b.values(c)), weight_of_pair = theta * b.values(c) - n.col(c).dot(stress_on_axes.col(c));
      for (int p = 0; p < 6; ++p) bases(p, pair) = n(row[p], a) * n(column[p], c) + n(row[p], c) * n(column[p], a);
      weighted.col(pair) = weight_of_pair * bases.col(pair);
    }
  }
  Eigen::Matrix<double, 6, 6> symmetric;
  symmetric.noalias() = weighted * bases.transpose();
  symmetric.topLeftCorner<3, 3>().array() += lambda;
  Eigen::Matrix<double, 9, 9> tangent;
  for (int q = 0; q < 9; ++q)
    for (int p = 0; p < 9; ++p) tangent(p, q) = symmetric(place[p], place[q]);
  for (int i = 0; i < 3; ++i) tangent.block<3, 3>(3 * i, 3 * i) += stress;
  return tangent;
}

/// A (see StressAndTangent) of tau_a = lambda tr e + 2 mu e_a + const with b = F B F^T for a constant B, at the Kirchhoff stress `stress`. As db = L
/// b + b L^T, in the axes of b the normal strains change by de_a = L_aa. Off the diagonal, for an isotropic function,
///   d tau_ab = theta_ab (L_ab b_b + b_a L_ba),   theta_ab = (tau_a - tau_b) / (b_a - b_b) = mu (ln b_a - ln b_b) / (b_a - b_b).
/// The slopes may be the secant ones of a law whose deviator is parallel to that of e. The caller adds the rest of its tangent.
template <class Components>
Eigen::Matrix<double, Components::size, Components::size> logarithmic_tangent(const Spectrum& b, double lambda, double mu, const Matrix3& stress) {
  constexpr int size = Components::size;
  if constexpr (size == SolidComponents::size) {
    return logarithmic_tangent_in_space(b, lambda, mu, stress);
  } else {
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
}

}  // namespace mortise
