#pragma once
// The balance of heat of a step.

#include <cmath>

#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// in = stored + out.
struct HeatBalance {
  double sum = 0.0;      ///< of all powers into the bodies, less what they store
  double largest = 0.0;  ///< of its summands
  /// 0 where nothing flows.
  double imbalance() const { return largest > 0.0 ? std::abs(sum) / largest : 0.0; }
};

/// Of the last step. Collective.
HeatBalance heat_balance(const Mesh& mesh, const HeatOfStep& heat);

}  // namespace mortise
