#include "mortise/input/expression.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <regex>

#include "split.hpp"

namespace mortise {
namespace {

// Calls a table, which a table's function gets as user data.
double evaluate_table(void* table, double time) { return (*static_cast<const Table*>(table))(time); }

const std::vector<std::string> time_and_position{"t", "x", "y", "z"};

// muParser takes "=" for an assignment to an argument.
bool assigns(const std::string& source) {
  static const std::regex single_equals("(^|[^=!<>])=([^=]|$)");
  return std::regex_search(source, single_equals);
}

/// True for numbers of C that an expression does not take: "nan", "inf", "1e400", "0x10".
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

/// Data that muParser needs for as long as the function lives.
struct Parsed {
  std::vector<double> arguments;  // never resized: the parser holds the addresses
  std::map<std::string, Table> tables;
  mu::Parser parser;

  double operator()(const std::vector<double>& values) {
    std::copy_n(values.begin(), arguments.size(), arguments.begin());
    return parser.Eval();
  }
};

}  // namespace

ScalarFunction parse_expression(const std::string& source, const Symbols& symbols, const Place& place) {
  return parse_expression(time_and_position, source, symbols, place);
}

ScalarFunction parse_expression(const std::vector<std::string>& arguments, const std::string& source, const Symbols& symbols, const Place& place) {
  for (const std::string& name : symbols.refused)
    if (has_word(source, name)) throw InputError(std::vector<Diagnostic>());
  if (assigns(source)) throw InputError(place, fmt::format("\"{}\" assigns with \"=\", which an expression cannot; \"==\" compares", source));
  const auto parsed = std::make_shared<Parsed>();
  parsed->arguments.resize(arguments.size(), 0.0);
  parsed->tables = symbols.tables;
  mu::Parser& parser = parsed->parser;
  double value = 0.0;
  bool constant = true;
  std::vector<char> reads;
  try {
    for (std::size_t i = 0; i < arguments.size(); ++i)
      if (!arguments[i].empty() && arguments[i].size() <= longest_name_in_expressions &&
          !std::isdigit(static_cast<unsigned char>(arguments[i].front())) &&
          arguments[i].find_first_not_of(parser.ValidNameChars()) == std::string::npos)
        parser.DefineVar(arguments[i], &parsed->arguments[i]);
    parser.DefineConst("pi", std::acos(-1.0));
    for (const auto& [name, number] : symbols.variables) parser.DefineConst(name, number);
    for (auto& [name, table] : parsed->tables) parser.DefineFunUserData(name, evaluate_table, &table);
    parser.SetExpr(source);
    int values = 0;
    value = parser.Eval(values)[0];
    if (values > 1)
      throw InputError(
          place, fmt::format("\"{}\" holds {} values separated by commas, where one is asked for; the decimal sign is a point", source, values));
    const auto& used = parser.GetUsedVar();
    constant = used.empty();
    for (const std::string& name : arguments) reads.push_back(used.count(name) > 0 ? 1 : 0);
  } catch (const mu::Parser::exception_type& error) {
    if (is_number_of_c(source)) throw InputError(place, fmt::format("\"{}\" is no finite decimal number; the largest is 1.797e308", source));
    if (error.GetCode() == mu::ecEXPRESSION_TOO_LONG)
      throw InputError(place, fmt::format("\"{}\" is an expression of {} characters; please write it in less than 20000", source, source.size()));
    throw InputError(place, fmt::format("cannot evaluate \"{}\": {}; known names: {}", source, error.GetMsg(), names_of(arguments, symbols)));
  }
  if (!constant) return ScalarFunction([parsed](const std::vector<double>& values) { return (*parsed)(values); }, source, place, std::move(reads));
  if (!std::isfinite(value))
    throw InputError(place, fmt::format("\"{}\" is {}, not a finite number", source, std::isnan(value) ? std::abs(value) : value));
  return ScalarFunction(value, source, place);
}

}  // namespace mortise
