#pragma once

#include "mortise/core/parameters.hpp"

namespace mortise {

/// sigma_y = sigma_0: no hardening.
struct PerfectPlasticity {
  static constexpr const char* name = "perfect";
  static constexpr const char* sentence = "constant yield stress";

  double initial_yield_stress = 1.0;  ///< sigma_0 [stress]

  void describe(Parameters& parameters) {
    parameters.add("yield stress", initial_yield_stress, Says("sigma_0, at which flow starts").unit("stress").above(0.0).required());
  }
  double yield_stress(double) const { return initial_yield_stress; }
  double slope(double) const { return 0.0; }
  double plastic_work(double alpha) const { return initial_yield_stress * alpha; }
};

}  // namespace mortise
