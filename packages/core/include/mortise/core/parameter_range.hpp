#pragma once
// Ranges of parameters: a check of a value, and the range as messages show it.

#include <string>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// True of a number within the bounds; false of one that is no number.
bool is_in_range(double value, const Says& says);

/// "> 0 and <= 1"; empty without bounds.
std::string range_text(const Says& says);

}  // namespace mortise
