#pragma once
// Properties that depend on the temperature: a number, an expression or a table.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/piecewise_linear.hpp"
#include "mortise/core/scalar_function.hpp"

namespace mortise {

/// f(theta). At most one of expression and table is given.
struct TemperatureFunction {
  /// Straight lines between points, constant beyond them.
  struct Table {
    std::vector<double> temperatures;  ///< of the points, ascending; empty: there is no table
    std::vector<double> values;        ///< there
    void describe(Parameters& parameters);
  };

  std::optional<ScalarFunction> expression;  ///< of `temperature`, or a constant; no value: not given
  Table table;

  TemperatureFunction() = default;
  TemperatureFunction(double constant) : expression(constant) {}
  TemperatureFunction(ScalarFunction of_temperature) : expression(std::move(of_temperature)) {}
  TemperatureFunction(std::vector<double> temperatures, std::vector<double> values) : table{std::move(temperatures), std::move(values)} {}

  /// Names the parameter `name` and the list `name table`.
  /// @param says  of the parameter, with its unit; without `arguments`
  void describe(Parameters& parameters, const std::string& name, Says says);

  bool is_given() const { return expression || !table.temperatures.empty(); }
  /// True of a number, and of a table of one point.
  bool is_constant() const { return expression ? expression->is_constant() : table.temperatures.size() == 1; }
  /// Value; NaN where the function throws or has none. It has to be given.
  double at(double temperature) const;
  /// Value and derivative: that of expressions is value_and_slope().
  ValueAndSlope with_slope(double temperature) const;
  /// Mean between two temperatures, the integral over their difference, and its derivative by `to`. Exact for tables; of expressions by an adaptive
  /// Gauss-Kronrod rule. The value at the temperature where both are equal.
  ValueAndSlope mean(double from, double to) const;
  /// Error in the points of the table; nothing: they make a function, or none is given.
  std::optional<std::string> fault() const;
  /// As messages show it: the expression between quotes, or "of the table".
  std::string source() const;
};

}  // namespace mortise
