#include "mortise/core/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

// What a table's function gets as user data.
double evaluate_table(void* table, double time) { return (*static_cast<const Table*>(table))(time); }

std::string names_of(const Symbols& symbols) {
  std::string names = "t, x, y, z, pi";
  for (const auto& [name, value] : symbols.variables) names += ", " + name;
  for (const auto& [name, table] : symbols.tables) names += ", " + name + "(t)";
  return names;
}

}  // namespace

double Table::operator()(double time) const {
  if (time <= times.front()) return values.front();
  if (time >= times.back()) return values.back();
  const auto next = std::upper_bound(times.begin(), times.end(), time) - times.begin();
  const double fraction = (time - times[next - 1]) / (times[next] - times[next - 1]);
  return values[next - 1] + fraction * (values[next] - values[next - 1]);
}

struct Expression::Parsed {
  std::string source;
  Place place;
  bool constant = true, positional = false;
  double value = 0.0;
  std::array<double, 4> arguments{};  // t, x, y, z
  std::map<std::string, Table> tables;
  mu::Parser parser;
};

Expression::Expression(double value) : parsed_(std::make_shared<Parsed>()) {
  parsed_->value = value;
  parsed_->source = fmt::format("{}", value);
}

Expression::Expression(const std::string& source, const Symbols& symbols, const Place& place) : parsed_(std::make_shared<Parsed>()) {
  Parsed& self = *parsed_;
  self.source = source;
  self.place = place;
  self.tables = symbols.tables;
  static constexpr const char* argument_names[4] = {"t", "x", "y", "z"};
  try {
    for (int i = 0; i < 4; ++i) self.parser.DefineVar(argument_names[i], &self.arguments[i]);
    self.parser.DefineConst("pi", std::acos(-1.0));
    for (const auto& [name, value] : symbols.variables) self.parser.DefineConst(name, value);
    for (auto& [name, table] : self.tables) self.parser.DefineFunUserData(name, evaluate_table, &table);
    self.parser.SetExpr(source);
    self.value = self.parser.Eval();
    for (const auto& [name, address] : self.parser.GetUsedVar()) {
      self.constant = false;
      self.positional |= name != "t";
    }
  } catch (const mu::Parser::exception_type& error) {
    throw InputError(place, fmt::format("cannot evaluate \"{}\": {}; known names: {}", source, error.GetMsg(), names_of(symbols)));
  }
  if (self.constant && !std::isfinite(self.value)) throw InputError(place, fmt::format("\"{}\" is {}, not a finite number", source, self.value));
}

double Expression::operator()(double t, double x, double y, double z) const {
  if (parsed_->constant) return parsed_->value;
  parsed_->arguments = {t, x, y, z};
  const double value = parsed_->parser.Eval();
  if (!std::isfinite(value))
    throw InputError(parsed_->place, fmt::format("\"{}\" is {} at t = {}, x = {}, y = {}, z = {}", parsed_->source, value, t, x, y, z));
  return value;
}

bool Expression::is_constant() const { return parsed_->constant; }
bool Expression::depends_on_position() const { return parsed_->positional; }
const std::string& Expression::source() const { return parsed_->source; }
const Place& Expression::place() const { return parsed_->place; }

}  // namespace mortise
