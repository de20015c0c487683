// The largest contact pressure.

#include <algorithm>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

std::unique_ptr<QuantityEvaluator> PeakPressure::make_evaluator(const QuantityContext& context) const {
  return evaluator_of([of_pair = find_pair(context, pair)](const QuantityContext& at) {
    double peak = 0.0;
    for (const auto& state : node_states(*at.laws, of_pair)) peak = std::max(peak, state.pressure);
    return largest_over_ranks(at.mesh(), peak);
  });
}

void add_peak_pressure(Registry<Quantity>& kinds) { kinds.add<PeakPressure>("peak pressure", "largest contact pressure of a pair"); }

}  // namespace mortise
