#pragma once
// Hencky's law: linear isotropic elasticity in logarithmic strain.

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/spectral.hpp"

namespace mortise {

/// W = G |dev e|^2 + K/2 (tr e)^2,   e = 1/2 ln b,   b = F F^T,   tau = 2 G dev e + K tr e I.
struct Hencky {
  static constexpr const char* name = "hencky";
  static constexpr const char* sentence = "linear isotropic elasticity in logarithmic strain; finite deformation";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = false;

  double shear_modulus, bulk_modulus;
  explicit Hencky(const ElasticConstants& constants) : shear_modulus(constants.shear_modulus()), bulk_modulus(constants.bulk_modulus()) {}

  /// Stored energy per reference volume.
  double energy(const Matrix3& F) const {
    const Eigen::Vector3d e = 0.5 * spectral_decomposition(F * F.transpose()).values.array().log().matrix();
    const double trace = e.sum();
    return shear_modulus * (e.squaredNorm() - trace * trace / 3.0) + 0.5 * bulk_modulus * trace * trace;
  }

  Matrix3 stress(const Matrix3& F) const { return stress(spectral_decomposition(F * F.transpose())); }

  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F) const {
    const Spectrum b = spectral_decomposition(F * F.transpose());
    StressAndTangent<Components> result;
    result.stress = stress(b);
    // db = L b + b L^T. In the axes of b the normal strains change by de_a = L_aa, and off the diagonal, for an isotropic function,
    // d tau_ab = theta_ab (L_ab b_b + b_a L_ba), theta_ab = (tau_a - tau_b) / (b_a - b_b) = G (ln b_a - ln b_b) / (b_a - b_b).
    const double lambda = bulk_modulus - 2.0 / 3.0 * shear_modulus;
    const Matrix3& n = b.vectors;
    constexpr int size = Components::size;
    using Column = Eigen::Matrix<double, size, 1>;
    Column dyads[3][3];  // dyads[a][c]: n_a n_c^T
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c)
        for (int p = 0; p < size; ++p) dyads[a][c](p) = n(Components::row[p], a) * n(Components::column[p], c);
    for (int q = 0; q < size; ++q)
      for (int p = 0; p < size; ++p) {
        const int i = Components::row[p], j = Components::column[p], k = Components::row[q], l = Components::column[q];
        // sum_a n_a n_a^T = I makes lambda I x I of the volumetric part; the geometric term is - tau_il delta_jk.
        result.tangent(p, q) = (i == j && k == l ? lambda : 0.0) - (j == k ? result.stress(i, l) : 0.0);
      }
    for (int a = 0; a < 3; ++a) {
      result.tangent.noalias() += 2.0 * shear_modulus * dyads[a][a] * dyads[a][a].transpose();
      for (int c = 0; c < a; ++c) {
        const double theta = shear_modulus * logarithm_slope(b.values(a), b.values(c));
        const Column both = theta * (dyads[a][c] + dyads[c][a]);
        result.tangent.noalias() += both * (b.values(c) * dyads[a][c] + b.values(a) * dyads[c][a]).transpose();
      }
    }
    return result;
  }

 private:
  Matrix3 stress(const Spectrum& b) const {
    const Eigen::Vector3d e = 0.5 * b.values.array().log().matrix();
    const Eigen::Vector3d principal = 2.0 * shear_modulus * e + (bulk_modulus - 2.0 / 3.0 * shear_modulus) * e.sum() * Eigen::Vector3d::Ones();
    return b.vectors * principal.asDiagonal() * b.vectors.transpose();
  }

  /// (ln a - ln b) / (a - b), 1 / b for a = b. log1p keeps it exact to round-off however close a and b are.
  static double logarithm_slope(double a, double b) {
    const double x = (a - b) / b;
    return (x == 0.0 ? 1.0 : std::log1p(x) / x) / b;
  }
};

}  // namespace mortise
