#include "straight_lines.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise::detail {

std::optional<std::string> fault_of_straight_lines(const std::vector<double>& points, const std::vector<double>& values, const char* of_points,
                                                   const char* of_values) {
  if (points.empty() || values.size() != points.size())
    return fmt::format("\"{}\" has {} values and \"{}\" {}; give as many of both, 1 or more", of_points, points.size(), of_values, values.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i]) || (i > 0 && !(points[i] > points[i - 1])))
      return fmt::format("\"{}\" has {:g} at place {}; values have to be finite and ascend", of_points, points[i], i + 1);
    if (!(values[i] >= 0.0) || !std::isfinite(values[i]))
      return fmt::format("\"{}\" has {:g} at place {}; values have to be finite and not negative", of_values, values[i], i + 1);
  }
  return std::nullopt;
}

}  // namespace mortise::detail
