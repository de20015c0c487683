#pragma once
// Active sets that come back in turn while nothing converges.

#include <array>
#include <cstddef>
#include <vector>

namespace mortise {

/// Watches the sequence of active sets of a Newton solve.
class CycleDetector {
 public:
  /// @param longest longest cycle that is looked for
  explicit CycleDetector(int longest) : longest_(longest) {}

  /// Takes the next iterate: a fingerprint of its active set and the size of the correction that led to it.
  void add(const std::array<long long, 2>& active_set, double increment);

  /// Length (2, 3, ...) of the cycle that the last iterates went through twice, or 0. An iterate repeats that of one cycle earlier under two
  /// conditions: its active set is the same, and its correction has not become smaller than half. Sets that return on the way to a solution are no
  /// cycle.
  int cycle() const;

 private:
  struct Iterate {
    std::array<long long, 2> active_set;
    double increment;
  };
  int longest_;
  std::vector<Iterate> iterates_;
};

}  // namespace mortise
