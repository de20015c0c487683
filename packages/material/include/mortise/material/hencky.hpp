#pragma once
// Hencky's law: linear isotropic elasticity in logarithmic strain.

#include <Eigen/LU>
#include <cmath>

#include "mortise/material/elastic_constants.hpp"
#include "mortise/material/logarithmic.hpp"

namespace mortise {

/// W = G |dev e|^2 + K/2 (tr e)^2,   e = 1/2 ln b,   b = F F^T,   tau = 2 G dev e + K tr e I.
struct Hencky {
  static constexpr const char* name = "hencky";
  static constexpr const char* sentence = "linear isotropic elasticity in logarithmic strain; finite deformation, also plane stress";
  static constexpr bool small_strain = false;
  static constexpr bool plane_stress = true;

  double shear_modulus, bulk_modulus;
  explicit Hencky(const ElasticConstants& constants) : shear_modulus(constants.shear_modulus()), bulk_modulus(constants.bulk_modulus()) {}

  /// Stored energy per reference volume.
  double energy(const Matrix3& F) const { return energy(logarithmic_strain(spectral_decomposition(F * F.transpose()))); }

  /// The energy of principal logarithmic strains.
  double energy(const Eigen::Vector3d& e) const {
    const double trace = e.sum();
    return shear_modulus * (e.squaredNorm() - trace * trace / 3.0) + 0.5 * bulk_modulus * trace * trace;
  }

  Matrix3 stress(const Matrix3& F) const { return stress(spectral_decomposition(F * F.transpose())); }

  template <class Components>
  StressAndTangent<Components> stress_and_tangent(const Matrix3& F) const {
    const Spectrum b = spectral_decomposition(F * F.transpose());
    StressAndTangent<Components> result;
    result.stress = stress(b);
    result.tangent = logarithmic_tangent<Components>(b, bulk_modulus - 2.0 / 3.0 * shear_modulus, shear_modulus, result.stress);
    return result;
  }

  /// F with the out-of-plane stretch that plane stress asks for: tau_33 = 0 gives e_33 = -lambda / (lambda + 2 G) (e_11 + e_22), where e_11 + e_22 is
  /// the logarithm of the in-plane determinant. The other components 13, 23, 31, 32 are zero.
  Matrix3 with_plane_stress(Matrix3 F) const {
    const double lambda = bulk_modulus - 2.0 / 3.0 * shear_modulus;
    F(2, 2) = std::pow(F.topLeftCorner<2, 2>().determinant(), -lambda / (lambda + 2.0 * shear_modulus));
    return F;
  }

 private:
  Matrix3 stress(const Spectrum& b) const {
    const Eigen::Vector3d e = logarithmic_strain(b);
    return in_axes_of(b, 2.0 * shear_modulus * e + (bulk_modulus - 2.0 / 3.0 * shear_modulus) * e.sum() * Eigen::Vector3d::Ones());
  }
};

}  // namespace mortise
