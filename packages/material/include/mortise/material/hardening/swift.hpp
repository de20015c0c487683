#pragma once

#include <algorithm>
#include <cmath>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// sigma_y = K (epsilon_0 + alpha)^n (Swift 1952). Steep at alpha = 0 for a small epsilon_0: the return map solves for the stress.
struct SwiftHardening {
  static constexpr const char* name = "swift";
  static constexpr const char* sentence = "strength coefficient * (initial strain + alpha)^exponent";

  double strength_coefficient = 1.0;  ///< K [stress]
  double initial_strain = 1.0;        ///< epsilon_0
  double exponent = 1.0;              ///< n

  void describe(Parameters& parameters) {
    parameters.add("strength coefficient", strength_coefficient, Says("K").unit("stress").above(0.0).required());
    parameters.add("initial strain", initial_strain, Says("epsilon_0; flow starts at K epsilon_0^n").unit("-").above(0.0).required());
    parameters.add("exponent", exponent, Says("n").unit("-").above(0.0).at_most(1.0).required());
  }
  double yield_stress(double alpha) const { return strength_coefficient * std::pow(initial_strain + alpha, exponent); }
  double slope(double alpha) const { return exponent * strength_coefficient * std::pow(initial_strain + alpha, exponent - 1.0); }
  double plastic_work(double alpha) const {
    const double power = exponent + 1.0;
    return strength_coefficient * (std::pow(initial_strain + alpha, power) - std::pow(initial_strain, power)) / power;
  }
  /// Inverse of yield_stress; 0 below it.
  double plastic_strain(double stress) const { return std::max(0.0, std::pow(stress / strength_coefficient, 1.0 / exponent) - initial_strain); }
};

}  // namespace mortise
