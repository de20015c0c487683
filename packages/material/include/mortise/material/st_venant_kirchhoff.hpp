#pragma once
// St Venant-Kirchhoff: linear isotropic elasticity in Green-Lagrange strain.

#include <cmath>

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// S = lambda tr E I + 2 mu E,   E = 1/2 (F^T F - I),   tau = F S F^T.
struct StVenantKirchhoff {
  static constexpr const char* name = "st venant kirchhoff";
  static constexpr const char* sentence =
      "linear isotropic elasticity in Green-Lagrange strain; large rotations with moderate strains, also plane stress";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = true;

  double lambda, mu;
  explicit StVenantKirchhoff(const ElasticConstants& constants) : lambda(constants.lame_lambda()), mu(constants.shear_modulus()) {}

  /// Stored energy per reference volume: lambda/2 (tr E)^2 + mu E:E.
  double energy(const Matrix3& F) const {
    const Matrix3 E = 0.5 * (F.transpose() * F - Matrix3::Identity());
    return 0.5 * lambda * E.trace() * E.trace() + mu * E.squaredNorm();
  }

  Matrix3 stress(const Matrix3& F) const {
    const Matrix3 E = 0.5 * (F.transpose() * F - Matrix3::Identity());
    return F * (lambda * E.trace() * Matrix3::Identity() + 2.0 * mu * E) * F.transpose();
  }

  /// A_ijkl = delta_ik tau_jl + lambda b_ij b_kl + mu (b_ik b_jl + b_il b_jk).
  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F) const {
    const Matrix3 b = F * F.transpose();
    StressAndTangent<Components> result;
    result.stress = stress(F);
    for (int q = 0; q < Components::size; ++q)
      for (int p = 0; p < Components::size; ++p) {
        const int i = Components::row[p], j = Components::column[p], k = Components::row[q], l = Components::column[q];
        result.tangent(p, q) = (i == k ? result.stress(j, l) : 0.0) + lambda * b(i, j) * b(k, l) + mu * (b(i, k) * b(j, l) + b(i, l) * b(j, k));
      }
    return result;
  }

  /// F with the out-of-plane stretch that plane stress asks for. S_33 = 0 gives E_33 = -lambda / (lambda + 2 mu) (E_11 + E_22) and
  /// F_33 = sqrt(1 + 2 E_33), 0 where the in-plane stretch leaves no thickness. The other components 13, 23, 31, 32 are zero.
  Matrix3 with_plane_stress(Matrix3 F) const {
    const double in_plane = 0.5 * (F.topLeftCorner<2, 2>().squaredNorm() - 2.0);
    F(2, 2) = std::sqrt(std::fmax(0.0, 1.0 - 2.0 * lambda / (lambda + 2.0 * mu) * in_plane));
    return F;
  }
};

}  // namespace mortise
