#pragma once
// Quantities with their first two derivatives by temperature.

#include "mortise/core/temperature_function.hpp"

namespace mortise {

/// A quantity f with df/dtheta and d2f/dtheta2.
struct TemperatureJet {
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;

  friend TemperatureJet operator+(const TemperatureJet& f, double c) { return {f.value + c, f.slope, f.curvature}; }
  friend TemperatureJet operator*(double c, const TemperatureJet& f) { return {c * f.value, c * f.slope, c * f.curvature}; }
  friend TemperatureJet operator*(const TemperatureJet& f, const TemperatureJet& g) {
    return {f.value * g.value, f.slope * g.value + f.value * g.slope, f.curvature * g.value + 2.0 * f.slope * g.slope + f.value * g.curvature};
  }
  /// Of q = f / g, f = q g gives f' = q' g + q g' and f'' = q'' g + 2 q' g' + q g''.
  friend TemperatureJet operator/(const TemperatureJet& f, const TemperatureJet& g) {
    TemperatureJet q;
    q.value = f.value / g.value;
    q.slope = (f.slope - q.value * g.slope) / g.value;
    q.curvature = (f.curvature - 2.0 * q.slope * g.slope - q.value * g.curvature) / g.value;
    return q;
  }
};

/// Derivatives of a function up to `order`, which is 0, 1 or 2; the others are 0.
TemperatureJet jet_of(const TemperatureFunction& function, double temperature, int order);

}  // namespace mortise
