#include "mortise/core/parameter_range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {

bool is_in_range(double value, const Says& says) {
  if (std::isnan(value)) return false;
  if (says.lower() && (says.lower_open() ? value <= *says.lower() : value < *says.lower())) return false;
  if (says.upper() && (says.upper_open() ? value >= *says.upper() : value > *says.upper())) return false;
  return true;
}

std::string range_text(const Says& says) {
  std::string text;
  if (says.lower()) text = fmt::format("{} {}", says.lower_open() ? ">" : ">=", *says.lower());
  if (says.upper()) text += fmt::format("{}{} {}", text.empty() ? "" : " and ", says.upper_open() ? "<" : "<=", *says.upper());
  return text;
}

}  // namespace mortise
