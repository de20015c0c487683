#pragma once

#include "mortise/material/hardening/voce.hpp"

namespace mortise {

/// sigma_y = sigma_0 + H alpha + Q (1 - exp(-delta alpha)).
struct LinearVoceHardening {
  static constexpr const char* name = "linear voce";
  static constexpr const char* sentence = "yield stress + modulus * alpha + saturation * (1 - exp(-rate * alpha))";

  VoceHardening voce;
  double modulus = 0.0;  ///< H [stress]

  void describe(Parameters& parameters) {
    voce.describe(parameters);
    parameters.add("modulus", modulus, Says("H, the slope that remains in the end").unit("stress").at_least(0.0).required());
  }
  double yield_stress(double alpha) const { return voce.yield_stress(alpha) + modulus * alpha; }
  double slope(double alpha) const { return voce.slope(alpha) + modulus; }
  double plastic_work(double alpha) const { return voce.plastic_work(alpha) + 0.5 * modulus * alpha * alpha; }
};

}  // namespace mortise
