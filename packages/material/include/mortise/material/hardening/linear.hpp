#pragma once

#include "mortise/core/parameters.hpp"

namespace mortise {

/// sigma_y = sigma_0 + H alpha.
struct LinearHardening {
  static constexpr const char* name = "linear";
  static constexpr const char* sentence = "yield stress + modulus * alpha";

  double initial_yield_stress = 1.0;  ///< sigma_0 [stress]
  double modulus = 0.0;               ///< H [stress]

  void describe(Parameters& parameters) {
    parameters.add("yield stress", initial_yield_stress, Says("sigma_0, at which flow starts").unit("stress").above(0.0).required());
    parameters.add("modulus", modulus,
                   Says("H, slope of the yield stress; softening has no unique solution and is refused").unit("stress").at_least(0.0).required());
  }
  double yield_stress(double alpha) const { return initial_yield_stress + modulus * alpha; }
  double slope(double) const { return modulus; }
  double plastic_work(double alpha) const { return (initial_yield_stress + 0.5 * modulus * alpha) * alpha; }
};

}  // namespace mortise
