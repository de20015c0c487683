#include "mortise/core/table.hpp"

#include <algorithm>
#include <cmath>

namespace mortise {

double Table::operator()(double time) const {
  if (std::isnan(time)) return time;
  if (time <= times.front()) return values.front();
  if (time >= times.back()) return values.back();
  const auto next = std::upper_bound(times.begin(), times.end(), time) - times.begin();
  const double fraction = (time - times[next - 1]) / (times[next] - times[next - 1]);
  return values[next - 1] + fraction * (values[next] - values[next - 1]);
}

}  // namespace mortise
