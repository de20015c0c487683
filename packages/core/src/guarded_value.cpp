#include "mortise/core/guarded_value.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

namespace mortise {

double value_or_nan(const ScalarFunction& function, const std::vector<double>& arguments, std::string* reason) {
  try {
    return function.at(arguments);
  } catch (const std::exception& error) {
    if (reason != nullptr) *reason = error.what();
    return std::numeric_limits<double>::quiet_NaN();
  }
}

ValueAndSlope value_and_slope(const ScalarFunction& function, std::vector<double> arguments, std::size_t i) {
  const double value = value_or_nan(function, arguments);
  if (function.is_constant()) return {value, 0.0};
  const double x = arguments.at(i), step = std::cbrt(std::numeric_limits<double>::epsilon()) * std::max(std::abs(x), 1.0);
  const auto value_at = [&](double argument) {
    arguments[i] = argument;
    return value_or_nan(function, arguments);
  };
  const double above = x + step, below = x - step;  // their difference is known exactly
  return {value, (value_at(above) - value_at(below)) / (above - below)};
}

}  // namespace mortise
