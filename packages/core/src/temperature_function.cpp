#include "mortise/core/temperature_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
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

namespace {

/// Integral of the straight lines from the first point to x.
double integral_of_lines(const std::vector<double>& points, const std::vector<double>& values, double x) {
  if (x <= points.front()) return (x - points.front()) * values.front();
  double sum = 0.0;
  std::size_t i = 1;
  for (; i < points.size() && points[i] <= x; ++i) sum += 0.5 * (points[i] - points[i - 1]) * (values[i] + values[i - 1]);
  return sum + 0.5 * (x - points[i - 1]) * (values[i - 1] + piecewise_linear(points, values, x).value);
}

}  // namespace

ValueAndSlope TemperatureFunction::mean(double from, double to) const {
  constexpr double close = 1e-6;  // of temperatures: the difference of two integrals would lose digits, the middle errs by its square
  const ValueAndSlope at_end = with_slope(to);
  if (is_constant()) return {at_end.value, 0.0};
  if (!(std::abs(to - from) > close * std::max(1.0, std::abs(to)))) return {at(0.5 * (from + to)), 0.5 * at_end.slope};
  double integral = 0.0;
  if (expression)
    integral = boost::math::quadrature::gauss_kronrod<double, 15>::integrate([this](double x) { return at(x); }, from, to, 8, 1e-12);
  else
    integral = integral_of_lines(table.temperatures, table.values, to) - integral_of_lines(table.temperatures, table.values, from);
  const double mean = integral / (to - from);
  return {mean, (at_end.value - mean) / (to - from)};
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
