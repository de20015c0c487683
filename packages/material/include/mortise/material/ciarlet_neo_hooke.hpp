#pragma once
// A compressible neo-Hookean law with Ciarlet's volumetric energy.

#include <Eigen/LU>
#include <cmath>

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// W = mu/2 (I1 - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J). Source: Ciarlet 1988; in wide use since Wriggers 2008.
/// tau = mu (b - I) + lambda/2 (J^2 - 1) I,
/// A_ijkl = mu delta_ik b_jl + (mu - lambda/2 (J^2 - 1)) delta_il delta_jk + lambda J^2 delta_ij delta_kl.
struct CiarletNeoHooke {
  static constexpr const char* name = "ciarlet neo hooke";
  static constexpr const char* sentence =
      "compressible neo-Hookean solid mu/2 (I1 - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J); finite deformation, also plane stress";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = true;

  double mu, lambda;
  explicit CiarletNeoHooke(const ElasticConstants& constants) : mu(constants.shear_modulus()), lambda(constants.lame_lambda()) {}

  /// Stored energy per reference volume.
  double energy(const Matrix3& F) const {
    const double J = F.determinant(), logarithm = std::log(J);
    return 0.5 * mu * (F.squaredNorm() - 3.0) - mu * logarithm + 0.25 * lambda * (J * J - 1.0 - 2.0 * logarithm);
  }

  Matrix3 stress(const Matrix3& F) const { return mu * F * F.transpose() + (pressure(F.determinant()) - mu) * Matrix3::Identity(); }

  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F) const {
    const double J = F.determinant(), p = pressure(J);
    const Matrix3 b = F * F.transpose();
    StressAndTangent<Components> result;
    result.stress = mu * b + (p - mu) * Matrix3::Identity();
    for (int q = 0; q < Components::size; ++q)
      for (int r = 0; r < Components::size; ++r) {
        const int i = Components::row[r], j = Components::column[r], k = Components::row[q], l = Components::column[q];
        result.tangent(r, q) = (i == k ? mu * b(j, l) : 0.0) + (i == l && j == k ? mu - p : 0.0) + (i == j && k == l ? lambda * J * J : 0.0);
      }
    return result;
  }

  /// F with the out-of-plane stretch that plane stress asks for: with the in-plane determinant j, tau_33 = 0 is
  /// mu (F_33^2 - 1) + lambda/2 (j^2 F_33^2 - 1) = 0. The other components 13, 23, 31, 32 are zero.
  Matrix3 with_plane_stress(Matrix3 F) const {
    const double j = F.topLeftCorner<2, 2>().determinant();
    F(2, 2) = std::sqrt((mu + 0.5 * lambda) / (mu + 0.5 * lambda * j * j));
    return F;
  }

 private:
  /// lambda/2 (J^2 - 1), tension positive.
  double pressure(double J) const { return 0.5 * lambda * (J * J - 1.0); }
};

}  // namespace mortise
