#include "mortise/core/piecewise_linear.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {

ValueAndSlope piecewise_linear(const std::vector<double>& points, const std::vector<double>& values, double x) {
  if (std::isnan(x)) return {x, x};
  if (x < points.front()) return {values.front(), 0.0};
  if (x >= points.back()) return {values.back(), 0.0};
  const auto next = std::upper_bound(points.begin(), points.end(), x) - points.begin();
  const double length = points[next] - points[next - 1], rise = values[next] - values[next - 1];
  return {values[next - 1] + (x - points[next - 1]) / length * rise, rise / length};
}

}  // namespace mortise
