#include "mortise/core/temperature_function.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "mortise/core/guarded_value.hpp"

namespace mortise {

void TemperatureFunction::Table::describe(Parameters& parameters) {
  parameters.add("temperatures", temperatures, "of the points, ascending; beyond them the value is constant; empty: there is no table");
  parameters.add("values", values, "at the points");
}

void TemperatureFunction::describe(Parameters& parameters, const std::string& name, Says says) {
  parameters.add(name, expression, says.arguments({"temperature"}));
  parameters.list(name + " table", table, fmt::format("straight lines between points, in the place of \"{}\"", name));
  if (const auto wrong = fault()) parameters.error(name + " table", *wrong);
}

double TemperatureFunction::at(double temperature) const {
  return expression ? value_or_nan(*expression, {temperature}) : piecewise_linear(table.temperatures, table.values, temperature).value;
}

ValueAndSlope TemperatureFunction::with_slope(double temperature) const {
  return expression ? value_and_slope(*expression, {temperature}, 0) : piecewise_linear(table.temperatures, table.values, temperature);
}

std::optional<std::string> TemperatureFunction::fault() const {
  if (table.values.size() != table.temperatures.size())
    return fmt::format("\"temperatures\" of a table has {} numbers and \"values\" {}; give as many of both", table.temperatures.size(),
                       table.values.size());
  if (expression && !table.temperatures.empty()) return "an expression and a table are given; give one of them";
  for (std::size_t i = 0; i < table.temperatures.size(); ++i) {
    if (!std::isfinite(table.temperatures[i]) || (i > 0 && !(table.temperatures[i] > table.temperatures[i - 1])))
      return fmt::format("\"temperatures\" of a table has {:g} at place {}; numbers have to be finite and ascend", table.temperatures[i], i + 1);
    if (!std::isfinite(table.values[i]))
      return fmt::format("\"values\" of a table has {:g} at place {}; numbers have to be finite", table.values[i], i + 1);
  }
  return std::nullopt;
}

std::string TemperatureFunction::source() const { return expression ? fmt::format("\"{}\"", expression->source()) : "of the table"; }

}  // namespace mortise
