// The extreme of another quantity over the steps.

#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/names.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

class OverTimeEvaluator final : public QuantityEvaluator {
 public:
  /// @param index  of the other quantity
  OverTimeEvaluator(std::size_t index, Extremum::Which which) : index_(index), which_(which) {}

  double evaluate(const QuantityContext& context) override {
    double value = context.earlier_values[index_];
    if (which_ == Extremum::Which::maximum_absolute) value = std::abs(value);
    if (!std::isnan(value)) {
      const double before = extreme_.value_or(value);
      extreme_ = which_ == Extremum::Which::minimum ? std::min(before, value) : std::max(before, value);
    }
    return extreme_.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  void serialize(StateArchive& archive, const std::string& name) override { mortise::serialize(archive, name + ".extreme", extreme_); }

 private:
  std::size_t index_;
  Extremum::Which which_;
  std::optional<double> extreme_;
};

/// The largest or smallest value that another quantity had at the end of any step so far; steps at which it was not a number are left out.
struct OverTime : Quantity {
  Located<std::string> quantity;  ///< named before this one
  Extremum::Which which = Extremum::Which::maximum;

  void describe(Parameters& parameters) override {
    parameters.add("quantity", quantity, Says("name of a quantity that stands before this one").required());
    parameters.add("which", which, Extremum::names(), "kind of extremum");
  }

  std::unique_ptr<QuantityEvaluator> make_evaluator(const QuantityContext& context) const override {
    const auto found = std::find(context.earlier.begin(), context.earlier.end(), quantity.value);
    if (found == context.earlier.end()) throw InputError(quantity.place, unknown_name("quantity before this one", quantity.value, context.earlier));
    return std::make_unique<OverTimeEvaluator>(static_cast<std::size_t>(found - context.earlier.begin()), which);
  }
};

}  // namespace

void add_over_time(Registry<Quantity>& kinds) {
  kinds.add<OverTime>("over time", "the largest or smallest value that a quantity before it had at the end of any step");
}

}  // namespace mortise
