#pragma once
// Value and slope of a piecewise linear function.

#include <vector>

namespace mortise {

/// Of a function at an argument.
struct ValueAndSlope {
  double value = 0.0;  ///< of the function
  double slope = 0.0;  ///< its derivative; at a point between two lines that of the right one
};

/// The straight lines between points, constant beyond them; NaN at NaN.
/// @param points  strictly ascending, one or more
/// @param values  [points]
ValueAndSlope piecewise_linear(const std::vector<double>& points, const std::vector<double>& values, double x);

}  // namespace mortise
