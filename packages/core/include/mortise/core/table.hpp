#pragma once
// Piecewise linear functions.

#include <vector>

namespace mortise {

/// Piecewise linear function of one argument, constant beyond its ends. `times` ascend strictly.
struct Table {
  std::vector<double> times;   ///< arguments, strictly ascending, one or more
  std::vector<double> values;  ///< [times]
  /// Value at `time`, between the nearest times by a straight line.
  double operator()(double time) const;
};

}  // namespace mortise
