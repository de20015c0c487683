#pragma once
// Isotropic elastic constants.

namespace mortise {

/// Young's modulus [stress] > 0 and Poisson's ratio in (-1, 1/2), and what follows from them.
struct ElasticConstants {
  double youngs_modulus = 1.0;
  double poissons_ratio = 0.0;

  double shear_modulus() const { return youngs_modulus / (2.0 * (1.0 + poissons_ratio)); }       ///< G = mu
  double bulk_modulus() const { return youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)); }  ///< K
  double lame_lambda() const { return bulk_modulus() - 2.0 / 3.0 * shear_modulus(); }            ///< lambda
  double plane_stress_lambda() const {
    return youngs_modulus * poissons_ratio / (1.0 - poissons_ratio * poissons_ratio);
  }  ///< 2 lambda mu / (lambda + 2 mu)
};

}  // namespace mortise
