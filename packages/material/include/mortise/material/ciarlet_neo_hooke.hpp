#pragma once
// A compressible neo-Hookean law with Ciarlet's volumetric energy.

#include <Eigen/LU>
#include <cmath>

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// W = mu/2 (I1 - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J)   (Ciarlet 1988; in wide use since Wriggers 2008).
/// tau = mu (b - I) + lambda/2 (J^2 - 1) I,
/// A_ijkl = mu delta_ik b_jl + (mu - lambda/2 (J^2 - 1)) delta_il delta_jk + lambda J^2 delta_ij delta_kl.
struct CiarletNeoHooke {
  static constexpr const char* name = "ciarlet neo hooke";
  static constexpr const char* sentence = "compressible neo-Hookean solid mu/2 (I1 - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J); finite deformation";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = false;

  double mu, lambda;
  explicit CiarletNeoHooke(const ElasticConstants& constants)
      : mu(constants.shear_modulus()), lambda(constants.lame_lambda()) {}

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

 private:
  /// lambda/2 (J^2 - 1), tension positive.
  double pressure(double J) const { return 0.5 * lambda * (J * J - 1.0); }
};

}  // namespace mortise
