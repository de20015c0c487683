#pragma once
// A scalar function of pseudo-time and reference position, given as text.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// Piecewise linear function of one argument, constant beyond its ends. `times` ascend strictly.
struct Table {
  std::vector<double> times;   ///< arguments, strictly ascending, one or more
  std::vector<double> values;  ///< [times]
  /// Value at `time`, between the nearest times by a straight line.
  double operator()(double time) const;
};

/// What expressions may name besides t, x, y, z and the usual functions: numbers by name, and tables called as `name(t)`.
struct Symbols {
  std::map<std::string, double> variables;  ///< by name
  std::map<std::string, Table> tables;      ///< by name
  std::vector<std::string> refused;         ///< variables and tables that the scene has and that are wrong, which has been said
};

/// A function f(t, x, y, z) parsed by muParser. Copies are cheap and share the parsed form.
class Expression {
 public:
  /// The constant `value`.
  Expression(double value = 0.0);

  /// Parses `source`. Throws InputError at `place` with what is wrong and what may be named; without diagnostics if `source` names what was refused.
  Expression(const std::string& source, const Symbols& symbols, const Place& place = {});

  /// A function of `arguments` instead of t, x, y, z. Arguments whose names cannot stand in an expression are left out.
  static Expression of(const std::vector<std::string>& arguments, const std::string& source, const Symbols& symbols, const Place& place = {});

  /// Value at the arguments given to of(), in their order, beyond which there may be more; not finite where the expression is not.
  double at(const std::vector<double>& arguments) const;

  /// Value at pseudo-time t and reference position (x, y, z), of t, x, y, z or the first of them. Throws InputError if it is not finite.
  double operator()(double t = 0.0, double x = 0.0, double y = 0.0, double z = 0.0) const;

  bool is_constant() const;           ///< depends on none of its arguments
  const std::string& source() const;  ///< as given; of a constant its shortest exact text
  /// Where the scene gives it.
  const Place& place() const;

 private:
  struct Parsed;
  explicit Expression(std::shared_ptr<Parsed> parsed) : parsed_(std::move(parsed)) {}
  std::shared_ptr<Parsed> parsed_;
};

}  // namespace mortise
