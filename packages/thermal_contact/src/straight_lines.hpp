#pragma once
// Checks of points that straight lines connect.

#include <optional>
#include <string>
#include <vector>

namespace mortise::detail {

/// Error in points that do not ascend, or values that are negative; nothing: they make a curve. Messages name both lists.
std::optional<std::string> fault_of_straight_lines(const std::vector<double>& points, const std::vector<double>& values, const char* of_points,
                                                   const char* of_values);

}  // namespace mortise::detail
