// Quantities made of other quantities.

#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/core/names.hpp"
#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {

void FormulaQuantity::describe(Parameters& parameters) {
  parameters.add("value", value, Says("expression of t, the scene's variables and the quantities named before this one").required());
}

void FormulaQuantity::prepare(const QuantityContext& context) {
  std::vector<std::string> arguments{"t"};
  arguments.insert(arguments.end(), context.earlier.begin(), context.earlier.end());
  formula_ = parse_expression(arguments, value.value, *context.symbols, value.place);
}

double FormulaQuantity::evaluate(const QuantityContext& context) {
  std::vector<double> arguments{context.time};
  arguments.insert(arguments.end(), context.earlier_values.begin(), context.earlier_values.end());
  const double result = formula_->at(arguments);
  return std::isfinite(result) ? result : std::numeric_limits<double>::quiet_NaN();
}

void OverTime::describe(Parameters& parameters) {
  parameters.add("quantity", quantity, Says("name of a quantity that stands before this one").required());
  parameters.add("which", which, Extremum::names(), "which extremum");
}

void OverTime::prepare(const QuantityContext& context) {
  const auto found = std::find(context.earlier.begin(), context.earlier.end(), quantity.value);
  if (found == context.earlier.end()) throw InputError(quantity.place, unknown_name("quantity before this one", quantity.value, context.earlier));
  index_ = static_cast<std::size_t>(found - context.earlier.begin());
  extreme_.reset();
}

double OverTime::evaluate(const QuantityContext& context) {
  double value = context.earlier_values[index_];
  if (which == Extremum::Which::maximum_absolute) value = std::abs(value);
  if (!std::isnan(value)) {
    const double before = extreme_.value_or(value);
    extreme_ = which == Extremum::Which::minimum ? std::min(before, value) : std::max(before, value);
  }
  return extreme_.value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace mortise
