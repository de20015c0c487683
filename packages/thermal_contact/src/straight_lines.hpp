#pragma once
// Values and slopes of straight lines between points.

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mortise::detail {

/// Value and slope at x of the straight lines between points, constant beyond them. At a point the slope is the right one.
std::pair<double, double> on_straight_lines(const std::vector<double>& points, const std::vector<double>& values, double x);

/// Error in points that do not ascend, or values that are negative; nothing: they make a curve. Messages name both lists.
std::optional<std::string> fault_of_straight_lines(const std::vector<double>& points, const std::vector<double>& values, const char* of_points,
                                                   const char* of_values);

}  // namespace mortise::detail
