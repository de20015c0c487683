#pragma once
// Whole numbers that come as floating point ones.

#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace mortise {

/// The whole number that `value` is; nothing if it is none, or one that the type cannot hold.
template <class Whole>
std::optional<Whole> whole_number(double value) {
  static_assert(std::is_integral_v<Whole>, "for whole numbers");
  const double limit = std::ldexp(1.0, std::numeric_limits<Whole>::digits);  // exact, unlike the largest number below it
  if (!(value >= (std::is_signed_v<Whole> ? -limit : 0.0) && value < limit) || value != std::trunc(value)) return std::nullopt;
  return static_cast<Whole>(value);
}

}  // namespace mortise
