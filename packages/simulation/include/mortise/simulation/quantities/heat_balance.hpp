#pragma once
// The balance of heat of a step.

#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// in = stored + out, step by step.
class HeatBalance {
 public:
  /// The sum of all powers of a step into the bodies, less what they store, over the largest power of any step so far. Where nothing flows that is no
  /// less than a hundred million times what round-off alone may leave. Collective.
  double imbalance(const Mesh& mesh, const HeatOfStep& heat);
  /// Stores or restores the largest power.
  void serialize(StateArchive& archive, const std::string& name) { mortise::serialize(archive, name + ".largest_power", largest_); }

 private:
  double largest_ = 0.0;
};

}  // namespace mortise
