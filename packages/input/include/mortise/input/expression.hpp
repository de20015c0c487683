#pragma once
// Functions given as text.

#include <map>
#include <string>
#include <vector>

#include "mortise/core/scalar_function.hpp"
#include "mortise/core/table.hpp"

namespace mortise {

/// Symbols of expressions besides t, x, y, z and the usual functions: numbers by name, and tables called as `name(t)`.
struct Symbols {
  std::map<std::string, double> variables;  ///< by name
  std::map<std::string, Table> tables;      ///< by name
  std::vector<std::string> refused;         ///< variables and tables that the scene has and that are wrong, which has been said
};

/// The function of t, x, y, z that muParser makes of `source`. Throws InputError at `place` with what is wrong and what may be named; without
/// diagnostics if `source` names what was refused.
ScalarFunction parse_expression(const std::string& source, const Symbols& symbols, const Place& place = {});

/// A function of `arguments` instead of t, x, y, z. Arguments whose names cannot stand in an expression are left out.
ScalarFunction parse_expression(const std::vector<std::string>& arguments, const std::string& source, const Symbols& symbols,
                                const Place& place = {});

}  // namespace mortise
