#include "newton_progress.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace mortise::detail {

int iterations_without_progress(const std::vector<NewtonIteration>& iterates) {
  std::set<std::array<long long, 2>> seen;
  double least = std::numeric_limits<double>::infinity();
  int progress = 0, closed = 0;
  for (const NewtonIteration& iterate : iterates) {
    const bool is_new = seen.insert(iterate.norms.active_set).second;
    if (iterate.iteration > 0 && is_new && iterate.norms.merit < least) ++progress;
    least = std::min(least, iterate.norms.merit);
    closed = std::max(closed, iterate.norms.active);
  }
  return iterates.back().iteration - std::min(progress, closed);
}

}  // namespace mortise::detail
