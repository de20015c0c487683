// The number of closed slave nodes.

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

struct ActiveCount : PairQuantity {
  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    return evaluator_of([of_pair = find_pair(context, pair)](const QuantityContext& at) {
      double count = 0.0;
      for (const auto& state : node_states(*at.laws, of_pair)) count += state.closed && state.carries ? 1.0 : 0.0;
      return sum_over_ranks(at.mesh(), count);
    });
  }
};

}  // namespace

void add_active_count(Registry<Quantity>& kinds) {
  kinds.add<ActiveCount>("active count", "number of closed slave nodes of a pair that carry a multiplier");
}

}  // namespace mortise
