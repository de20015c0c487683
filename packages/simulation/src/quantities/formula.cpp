// A number made of other quantities.

#include <cmath>
#include <limits>

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

void FormulaQuantity::describe(Parameters& parameters) {
  parameters.add("value", value, Says("expression of t, the scene's variables and the quantities named before this one").required());
}

std::unique_ptr<QuantityEvaluator> FormulaQuantity::make_evaluator(const QuantityContext& context) const {
  std::vector<std::string> names{"t"};
  names.insert(names.end(), context.earlier.begin(), context.earlier.end());
  return evaluator_of([formula = parse_expression(names, value.value, *context.symbols, value.place)](const QuantityContext& at) {
    std::vector<double> arguments{at.time};
    arguments.insert(arguments.end(), at.earlier_values.begin(), at.earlier_values.end());
    const double result = formula.at(arguments);
    return std::isfinite(result) ? result : std::numeric_limits<double>::quiet_NaN();
  });
}

void add_formula(Registry<Quantity>& kinds) {
  kinds.add<FormulaQuantity>("formula", "an expression of t, the scene's variables and the quantities before it");
}

}  // namespace mortise
