#pragma once

#include <cmath>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// sigma_y = sigma_0 + Q (1 - exp(-delta alpha)) (Voce 1948).
struct VoceHardening {
  static constexpr const char* name = "voce";
  static constexpr const char* sentence = "yield stress + saturation * (1 - exp(-rate * alpha))";

  double initial_yield_stress = 1.0;  ///< sigma_0 [stress]
  double saturation = 1.0;            ///< Q [stress]
  double rate = 1.0;                  ///< delta

  void describe(Parameters& parameters) {
    parameters.add("yield stress", initial_yield_stress, Says("sigma_0, at which flow starts").unit("stress").above(0.0).required());
    parameters.add("saturation", saturation, Says("Q, increase of the yield stress in the end").unit("stress").at_least(0.0).required());
    parameters.add("rate", rate, Says("delta, rate of this increase").unit("-").above(0.0).required());
  }
  double yield_stress(double alpha) const { return initial_yield_stress - saturation * std::expm1(-rate * alpha); }
  double slope(double alpha) const { return saturation * rate * std::exp(-rate * alpha); }
  double plastic_work(double alpha) const { return (initial_yield_stress + saturation) * alpha + saturation * std::expm1(-rate * alpha) / rate; }
};

}  // namespace mortise
