#pragma once
// Values of functions of a host that may throw on one rank alone.

#include <string>
#include <vector>

#include "mortise/core/scalar_function.hpp"

namespace mortise {

/// Value at `arguments`; NaN where the function throws an exception, as other ranks go on and would wait for this one.
/// @param reason  gets the text of that exception; null: it is not wanted
double value_or_nan(const ScalarFunction& function, const std::vector<double>& arguments, std::string* reason = nullptr);

}  // namespace mortise
