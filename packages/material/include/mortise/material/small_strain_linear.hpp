#pragma once
// Hooke's law for small displacement gradients.

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// sigma = lambda tr e I + 2 mu e,   e = sym(F - I). Nothing of the geometry is updated: gradients and volumes are those of the reference
/// configuration, and A_ijkl = C_ijkl without a geometric term.
struct SmallStrainLinear {
  static constexpr const char* name = "small strain linear";
  static constexpr const char* sentence = "Hooke's law for small strains and rotations on the reference configuration; also plane stress";
  static constexpr bool small_strain = true;
  static constexpr bool plane_stress = true;

  double lambda, mu;
  explicit SmallStrainLinear(const ElasticConstants& constants) : lambda(constants.lame_lambda()), mu(constants.shear_modulus()) {}

  /// Stored energy per reference volume.
  double energy(const Matrix3& F) const {
    const Matrix3 e = 0.5 * (F + F.transpose()) - Matrix3::Identity();
    return 0.5 * lambda * e.trace() * e.trace() + mu * e.squaredNorm();
  }

  Matrix3 stress(const Matrix3& F) const {
    const Matrix3 e = 0.5 * (F + F.transpose()) - Matrix3::Identity();
    return lambda * e.trace() * Matrix3::Identity() + 2.0 * mu * e;
  }

  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F) const {
    StressAndTangent<Components> result;
    result.stress = stress(F);
    for (int q = 0; q < Components::size; ++q)
      for (int p = 0; p < Components::size; ++p) {
        const int i = Components::row[p], j = Components::column[p], k = Components::row[q], l = Components::column[q];
        result.tangent(p, q) = (i == j && k == l ? lambda : 0.0) + mu * ((i == k && j == l ? 1.0 : 0.0) + (i == l && j == k ? 1.0 : 0.0));
      }
    return result;
  }

  /// F with e_33 = -lambda / (lambda + 2 mu) (e_11 + e_22), so that sigma_33 = 0.
  Matrix3 with_plane_stress(Matrix3 F) const {
    F(2, 2) = 1.0 - lambda / (lambda + 2.0 * mu) * (F(0, 0) + F(1, 1) - 2.0);
    return F;
  }
};

}  // namespace mortise
