#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cctype>

#include "mortise/core/names.hpp"
#include "mortise/input/expression.hpp"
#include "mortise/input/xml.hpp"
#include "split.hpp"

namespace mortise {
namespace {

bool valid_name(const std::string& name) {
  return !name.empty() && name.size() <= longest_name_in_expressions && (std::isalpha(static_cast<unsigned char>(name[0])) || name[0] == '_') &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

// Reserved because expressions use them.
const std::vector<std::string> reserved = {"t",    "x",    "y",    "z",    "pi",    "sin",   "cos",   "tan",  "asin",  "acos",
                                           "atan", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "log2", "log10", "log",
                                           "ln",   "exp",  "sqrt", "sign", "rint",  "abs",   "min",   "max",  "sum",   "avg"};

bool is_reserved(const std::string& name) { return std::find(reserved.begin(), reserved.end(), name) != reserved.end(); }

std::string wrong_name(const std::string& name) {
  if (!valid_name(name))
    return fmt::format("\"{}\" cannot be named in expressions; please use letters, digits and underscores, {} of them at most", name,
                       longest_name_in_expressions);
  if (is_reserved(name)) return fmt::format("\"{}\" already has a meaning in expressions; please choose another name", name);
  return "";
}

std::vector<double> numbers(const XmlParameter* parameter, const Symbols& symbols) try {
  std::vector<double> values;
  for (const std::string& one : split(parameter->value)) {
    values.push_back(parse_expression({}, one, symbols, parameter->place)());
  }
  return values;
} catch (const InputError& error) {
  std::vector<Diagnostic> diagnostics = error.diagnostics();
  for (Diagnostic& diagnostic : diagnostics) diagnostic.message = fmt::format("\"{}\": {}", parameter->name, diagnostic.message);
  throw InputError(diagnostics);
}

Table read_table(const XmlList& list, const Symbols& symbols) {
  for (const char* name : {"times", "values"})
    if (!list.parameter(name)) throw InputError(list.place, fmt::format("a table needs \"times\" and \"values\"; \"{}\" is missing", name));
  for (const XmlParameter& parameter : list.parameters)
    if (parameter.name != "times" && parameter.name != "values")
      throw InputError(parameter.place, fmt::format("unknown parameter \"{}\"{}; a table has \"times\" and \"values\"", parameter.name,
                                                    did_you_mean(parameter.name, {"times", "values"})));
  Table table{numbers(list.parameter("times"), symbols), numbers(list.parameter("values"), symbols)};
  if (table.times.empty()) throw InputError(list.place, "the table is empty");
  if (table.times.size() != table.values.size())
    throw InputError(list.parameter("values")->place, fmt::format("{} times but {} values", table.times.size(), table.values.size()));
  for (std::size_t i = 1; i < table.times.size(); ++i)
    if (table.times[i] <= table.times[i - 1])
      throw InputError(list.parameter("times")->place, fmt::format("times have to ascend, but {} follows {}", table.times[i], table.times[i - 1]));
  return table;
}

}  // namespace

bool has_word(const std::string& text, const std::string& name) {
  const auto is_of_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !is_of_name(text[at - 1])) && (end == text.size() || !is_of_name(text[end]))) return true;
  }
  return false;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::string part;
  int depth = 0;
  for (const char c : text) {
    depth += c == '(';
    depth -= c == ')';
    if (c == ',' && depth == 0) {
      parts.push_back(boost::algorithm::trim_copy(part));
      part.clear();
    } else {
      part += c;
    }
  }
  boost::algorithm::trim(part);
  if (!part.empty() || !parts.empty()) parts.push_back(part);
  return parts;
}

Symbols read_symbols(const XmlList& root, std::vector<Diagnostic>& diagnostics) {
  Symbols symbols;
  // A name with a meaning of its own keeps it in expressions.
  const auto refuse = [&](const std::string& name, const std::vector<Diagnostic>& wrong) {
    if (!is_reserved(name)) symbols.refused.push_back(name);
    diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  };
  const auto attempt = [&](const Place& place, const std::string& name, const auto& read) {
    if (const std::string wrong = wrong_name(name); !wrong.empty()) return refuse(name, {{place, wrong}});
    try {
      read();
    } catch (const InputError& error) {
      refuse(name, error.diagnostics());
    }
  };
  for (const char* name : {"variables", "tables"})
    if (const XmlParameter* parameter = root.parameter(name))
      diagnostics.push_back({parameter->place, fmt::format("\"{}\" is a list, not a parameter", name)});
  if (const XmlList* variables = root.list("variables")) {
    for (const XmlList& list : variables->lists) refuse(list.name, {{list.place, "a variable is a parameter, not a list"}});
    for (const XmlParameter& one : variables->parameters)
      attempt(one.place, one.name, [&] {
        for (const XmlParameter* later = &one; later <= &variables->parameters.back(); ++later)
          if (wrong_name(later->name).empty() && has_word(one.value, later->name))
            throw InputError(one.place,
                             fmt::format("variable \"{}\" is \"{}\", but it may use only variables that stand above it", one.name, one.value));
        const std::vector<double> value = numbers(&one, symbols);
        if (value.size() != 1) throw InputError(one.place, fmt::format("variable \"{}\" is \"{}\"; please give one number", one.name, one.value));
        symbols.variables[one.name] = value[0];
      });
  }
  if (const XmlList* tables = root.list("tables")) {
    for (const XmlParameter& one : tables->parameters)
      refuse(one.name, {{one.place, fmt::format("table \"{}\" is a parameter; a table is a list with \"times\" and \"values\"", one.name)}});
    for (const XmlList& list : tables->lists)
      attempt(list.place, list.name, [&] {
        if (symbols.variables.count(list.name) != 0)
          throw InputError(list.place, fmt::format("there is a variable named \"{}\" already; please give the table another name", list.name));
        symbols.tables[list.name] = read_table(list, symbols);
      });
  }
  return symbols;
}

}  // namespace mortise
