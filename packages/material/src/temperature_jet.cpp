#include "temperature_jet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mortise {
namespace {

/// A central difference of fourth order of an expression, with the step h = eps^(1/6) max(|theta|, 1): round-off 16/3 eps / h^2 and truncation
/// h^4 / 90 are at most some eps^(2/3) of a function that varies over max(|theta|, 1). The lines of a table have none.
double curvature_of(const TemperatureFunction& function, double temperature) {
  if (function.is_constant() || !function.expression) return 0.0;
  const double h = std::pow(std::numeric_limits<double>::epsilon(), 1.0 / 6.0) * std::max(std::abs(temperature), 1.0);
  const auto both = [&](double step) { return function.at(temperature + step) + function.at(temperature - step); };
  return (16.0 * both(h) - both(2.0 * h) - 30.0 * function.at(temperature)) / (12.0 * h * h);
}

}  // namespace

TemperatureJet jet_of(const TemperatureFunction& function, double temperature, int order) {
  if (order == 0) return {function.at(temperature), 0.0, 0.0};
  const auto [value, slope] = function.with_slope(temperature);
  return {value, slope, order > 1 ? curvature_of(function, temperature) : 0.0};
}

}  // namespace mortise
