#include "multigrid/reuse_policy.hpp"

#include <algorithm>

namespace mortise::detail {

void ReusePolicy::record(int iterations, double digits) {
  iterations_ += iterations;
  digits_ += digits;
  least_average_ = std::min(least_average_, iterations_ / digits_);
  beyond_ += std::max(0.0, iterations - digits * least_average_);
}

}  // namespace mortise::detail
