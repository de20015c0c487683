#pragma once

#include <cmath>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// sigma_y = sigma_0 + k alpha^n (Ludwik 1909). Its slope is infinite at alpha = 0, that of its inverse is zero: the return map solves for the
/// stress.
struct LudwikHardening {
  static constexpr const char* name = "ludwik";
  static constexpr const char* sentence = "yield stress + strength coefficient * alpha^exponent";

  double initial_yield_stress = 1.0;  ///< sigma_0 [stress]
  double strength_coefficient = 1.0;  ///< k [stress]
  double exponent = 1.0;              ///< n

  void describe(Parameters& parameters) {
    parameters.add("yield stress", initial_yield_stress, Says("sigma_0, at which flow starts").unit("stress").above(0.0).required());
    parameters.add("strength coefficient", strength_coefficient,
                   Says("k, increase of the yield stress up to alpha = 1").unit("stress").above(0.0).required());
    parameters.add("exponent", exponent, Says("n").unit("-").above(0.0).at_most(1.0).required());
  }
  double yield_stress(double alpha) const { return initial_yield_stress + strength_coefficient * std::pow(alpha, exponent); }
  double slope(double alpha) const { return exponent * strength_coefficient * std::pow(alpha, exponent - 1.0); }
  double plastic_work(double alpha) const {
    return (initial_yield_stress + strength_coefficient * std::pow(alpha, exponent) / (exponent + 1.0)) * alpha;
  }
  /// Inverse of yield_stress; 0 below it.
  double plastic_strain(double stress) const {
    return stress <= initial_yield_stress ? 0.0 : std::pow((stress - initial_yield_stress) / strength_coefficient, 1.0 / exponent);
  }
};

}  // namespace mortise
