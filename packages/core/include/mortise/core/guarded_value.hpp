#pragma once
// Values of functions of a host that may throw on one rank alone.

#include <cstddef>
#include <string>
#include <vector>

#include "mortise/core/piecewise_linear.hpp"
#include "mortise/core/scalar_function.hpp"

namespace mortise {

/// Value at `arguments`; NaN where the function throws an exception, as other ranks go on and would wait for this one.
/// @param reason  gets the text of that exception; null: it is not wanted
double value_or_nan(const ScalarFunction& function, const std::vector<double>& arguments, std::string* reason = nullptr);

/// Value and partial derivative by the argument x_i. The derivative is a central difference with the step eps^(1/3) max(|x_i|, 1): of a function that
/// varies over a length L its error is about eps^(2/3) (x_i / L)^2, some 1e-10. NaN where the function throws or has no value.
ValueAndSlope value_and_slope(const ScalarFunction& function, std::vector<double> arguments, std::size_t i);

}  // namespace mortise
