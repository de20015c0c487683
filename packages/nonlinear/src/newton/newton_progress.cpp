#include "newton/newton_progress.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace mortise::detail {
namespace {
/// Merit of the field that contact changes its states with.
double merit_of_motion(const ResidualNorms& norms) { return norms.fields.empty() ? norms.merit : norms.fields.front().merit; }
}  // namespace

int iterations_without_progress(const std::vector<NewtonIteration>& iterates) {
  std::set<std::array<long long, 2>> seen;
  double least = std::numeric_limits<double>::infinity();
  int progress = 0, closed = 0;
  for (const NewtonIteration& iterate : iterates) {
    const bool is_new = seen.insert(iterate.norms.active_set).second;
    if (iterate.iteration > 0 && is_new && merit_of_motion(iterate.norms) < least) ++progress;
    least = std::min(least, merit_of_motion(iterate.norms));
    closed = std::max(closed, iterate.norms.active);
  }
  return iterates.back().iteration - std::min(progress, closed);
}

bool wanders(const std::vector<NewtonIteration>& iterates) {
  constexpr std::size_t patience = 12, half = patience / 2;
  constexpr double few = 0.05;  // of the closed nodes
  if (iterates.size() <= patience) return false;
  const double start = merit_of_motion(iterates.front().norms);
  int before = 0, now = 0, closed = 0;
  for (std::size_t back = 1; back < iterates.size(); ++back) {
    const ResidualNorms& norms = iterates[iterates.size() - back].norms;
    if (merit_of_motion(norms) < start) return false;
    if (back <= half) {
      now += norms.changed;
      closed += norms.active;
    } else if (back <= patience) {
      before += norms.changed;
    }
  }
  return now >= before && now > few * closed;
}

}  // namespace mortise::detail
