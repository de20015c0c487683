#include "mortise/core/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <regex>

#include "split.hpp"

namespace mortise {
namespace {

// What a table's function gets as user data.
double evaluate_table(void* table, double time) { return (*static_cast<const Table*>(table))(time); }

const std::vector<std::string> time_and_position{"t", "x", "y", "z"};

// muParser takes "=" for an assignment to an argument.
bool assigns(const std::string& source) { return std::regex_search(source, std::regex("(^|[^=!<>])=([^=]|$)")); }

// Without the sign that some operations give what is not a number.
double shown(double value) { return std::isnan(value) ? std::abs(value) : value; }

/// What C takes for a number and an expression does not: "nan", "inf", "1e400", "0x10".
bool is_number_of_c(const std::string& source) {
  char* end = nullptr;
  std::strtod(source.c_str(), &end);
  return !source.empty() && end == source.c_str() + source.size();
}

std::string names_of(const std::vector<std::string>& arguments, const Symbols& symbols) {
  std::string names;
  for (const auto& name : arguments) names += name + ", ";
  names += "pi";
  for (const auto& [name, value] : symbols.variables) names += ", " + name;
  for (const auto& [name, table] : symbols.tables) names += ", " + name + "(t)";
  if (arguments.empty()) names += "; t, x, y and z have no value here";
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
  bool constant = true;
  double value = 0.0;
  std::vector<double> arguments;  // never resized: the parser holds the addresses
  std::map<std::string, Table> tables;
  mu::Parser parser;

  Parsed(const std::string& text, const std::vector<std::string>& names, const Symbols& symbols, const Place& where)
      : source(text), place(where), arguments(names.size(), 0.0), tables(symbols.tables) {
    for (const std::string& name : symbols.refused)
      if (has_word(source, name)) throw InputError(std::vector<Diagnostic>());
    if (assigns(source)) throw InputError(place, fmt::format("\"{}\" assigns with \"=\", which an expression cannot; \"==\" compares", source));
    try {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (!names[i].empty() && !std::isdigit(static_cast<unsigned char>(names[i].front())) &&
            names[i].find_first_not_of(parser.ValidNameChars()) == std::string::npos)
          parser.DefineVar(names[i], &arguments[i]);
      parser.DefineConst("pi", std::acos(-1.0));
      for (const auto& [name, number] : symbols.variables) parser.DefineConst(name, number);
      for (auto& [name, table] : tables) parser.DefineFunUserData(name, evaluate_table, &table);
      parser.SetExpr(source);
      int values = 0;
      value = parser.Eval(values)[0];
      if (values > 1)
        throw InputError(
            place, fmt::format("\"{}\" holds {} values separated by commas, where one is asked for; the decimal sign is a point", source, values));
      constant = parser.GetUsedVar().empty();
    } catch (const mu::Parser::exception_type& error) {
      if (is_number_of_c(source)) throw InputError(place, fmt::format("\"{}\" is no finite decimal number; the largest is 1.797e308", source));
      if (error.GetCode() == mu::ecEXPRESSION_TOO_LONG)
        throw InputError(place, fmt::format("\"{}\" is an expression of {} characters; please write it in less than 20000", source, source.size()));
      throw InputError(place, fmt::format("cannot evaluate \"{}\": {}; known names: {}", source, error.GetMsg(), names_of(names, symbols)));
    }
    if (constant && !std::isfinite(value)) throw InputError(place, fmt::format("\"{}\" is {}, not a finite number", source, shown(value)));
  }
  explicit Parsed(double number) : source(fmt::format("{}", number)), value(number) {}
};

Expression::Expression(double value) : parsed_(std::make_shared<Parsed>(value)) {}

Expression::Expression(const std::string& source, const Symbols& symbols, const Place& place)
    : parsed_(std::make_shared<Parsed>(source, time_and_position, symbols, place)) {}

Expression Expression::of(const std::vector<std::string>& arguments, const std::string& source, const Symbols& symbols, const Place& place) {
  return Expression(std::make_shared<Parsed>(source, arguments, symbols, place));
}

double Expression::at(const std::vector<double>& arguments) const {
  if (parsed_->constant) return parsed_->value;
  // The parser holds the addresses of these numbers.
  std::copy_n(arguments.begin(), parsed_->arguments.size(), parsed_->arguments.begin());
  return parsed_->parser.Eval();
}

double Expression::operator()(double t, double x, double y, double z) const {
  if (parsed_->constant) return parsed_->value;
  const double value = at({t, x, y, z});
  if (!std::isfinite(value))
    throw InputError(parsed_->place,
                     fmt::format("\"{}\" is {} at t = {:g}, x = {:g}, y = {:g}, z = {:g}", parsed_->source, shown(value), t, x, y, z));
  return value;
}

bool Expression::is_constant() const { return parsed_->constant; }
const std::string& Expression::source() const { return parsed_->source; }
const Place& Expression::place() const { return parsed_->place; }

}  // namespace mortise
