#include "mortise/nonlinear/cycle_detector.hpp"

namespace mortise {

void CycleDetector::add(const std::array<long long, 2>& active_set, double increment) { iterates_.push_back({active_set, increment}); }

int CycleDetector::cycle() const {
  const std::size_t count = iterates_.size();
  for (std::size_t length = 2; static_cast<int>(length) <= longest_ && 2 * length <= count; ++length) {
    bool repeats = true, settled = true;
    for (std::size_t i = count - length; i < count && repeats; ++i) {
      const Iterate &now = iterates_[i], &before = iterates_[i - length];
      repeats = now.active_set == before.active_set && now.increment > 0.5 * before.increment;
      settled = settled && now.active_set == iterates_[count - 1].active_set;
    }
    if (repeats && !settled) return static_cast<int>(length);
  }
  return 0;
}

}  // namespace mortise
