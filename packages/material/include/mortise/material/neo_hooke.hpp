#pragma once
// A compressible neo-Hookean law.

#include <Eigen/LU>
#include <cmath>

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// W = c (I1 - 3) + (c / beta) (J^(-2 beta) - 1),   c = E / (4 (1 + nu)),   beta = nu / (1 - 2 nu). For nu = 0 its limit: c (I1 - 3) - 2 c ln J.
/// tau = 2 c (b - J^(-2 beta) I),   A_ijkl = 2 c delta_ik b_jl + 2 c J^(-2 beta) (delta_il delta_jk + 2 beta delta_ij delta_kl).
struct NeoHooke {
  static constexpr const char* name = "neo hooke";
  static constexpr const char* sentence =
      "compressible neo-Hookean solid c (I1 - 3) + (c / beta) (J^(-2 beta) - 1); finite deformation, also plane stress";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = true;

  double c, beta;
  explicit NeoHooke(const ElasticConstants& constants)
      : c(0.5 * constants.shear_modulus()), beta(constants.poissons_ratio / (1.0 - 2.0 * constants.poissons_ratio)) {}

  /// Stored energy per reference volume.
  double energy(const Matrix3& F) const {
    const double logarithm = std::log(F.determinant()), x = -2.0 * beta * logarithm;
    return c * (F.squaredNorm() - 3.0) - 2.0 * c * logarithm * (x == 0.0 ? 1.0 : std::expm1(x) / x);
  }

  Matrix3 stress(const Matrix3& F) const { return 2.0 * c * (F * F.transpose() - power(F) * Matrix3::Identity()); }

  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F) const {
    const Matrix3 b = F * F.transpose();
    const double volumetric = power(F);
    StressAndTangent<Components> result;
    result.stress = 2.0 * c * (b - volumetric * Matrix3::Identity());
    for (int q = 0; q < Components::size; ++q)
      for (int p = 0; p < Components::size; ++p) {
        const int i = Components::row[p], j = Components::column[p], k = Components::row[q], l = Components::column[q];
        const double isotropic = (i == l && j == k ? 1.0 : 0.0) + (i == j && k == l ? 2.0 * beta : 0.0);
        result.tangent(p, q) = 2.0 * c * ((i == k ? b(j, l) : 0.0) + volumetric * isotropic);
      }
    return result;
  }

  /// F with the out-of-plane stretch that plane stress asks for: with the in-plane determinant j, tau_33 = 0 is F_33^2 = (j F_33)^(-2 beta), so that
  /// F_33 = j^(-beta / (1 + beta)) = j^(-nu / (1 - nu)). The other components 13, 23, 31, 32 are zero.
  Matrix3 with_plane_stress(Matrix3 F) const {
    F(2, 2) = std::pow(F.topLeftCorner<2, 2>().determinant(), -beta / (1.0 + beta));
    return F;
  }

 private:
  double power(const Matrix3& F) const { return std::pow(F.determinant(), -2.0 * beta); }
};

}  // namespace mortise
