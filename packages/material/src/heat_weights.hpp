#pragma once
// Weights of both ends of a step in its heat.

#include <algorithm>
#include <limits>

#include "mortise/material/thermal_law.hpp"

namespace mortise {

/// The heat of a step is (1 - s) times that at the temperatures of its end and s times that at those of its start. With s > 0 a point remembers the
/// temperatures of the last accepted state; s = 0, backward Euler, needs none.
class HeatWeights {
 public:
  explicit HeatWeights(double share_at_start) : start_(share_at_start) {}
  double at_end() const { return 1.0 - start_; }
  double at_start() const { return start_; }
  bool has_start() const { return start_ > 0.0; }

  int state_size() const { return has_start() ? 2 : 0; }
  /// No temperatures are known yet: stresses are not finite before remember().
  void start(double* state) const { std::fill_n(state, state_size(), std::numeric_limits<double>::quiet_NaN()); }
  void remember(const ThermalPoint& at, double* state) const {
    if (!has_start()) return;
    state[0] = at.expansion_temperature;
    state[1] = at.temperature;
  }

  /// The end of the step with the temperatures of its start.
  static ThermalPoint with_start(ThermalPoint at, const double* state) {
    at.expansion_temperature = state[0];
    at.temperature = state[1];
    return at;
  }

 private:
  double start_;  ///< s
};

}  // namespace mortise
