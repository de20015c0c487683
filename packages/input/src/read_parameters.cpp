#include "mortise/input/read_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mortise/core/names.hpp"
#include "mortise/core/parameter_range.hpp"
#include "mortise/core/whole_number.hpp"
#include "mortise/input/expression.hpp"
#include "split.hpp"

namespace mortise {
namespace {

std::string joined_path(const std::string& path, const std::string& name) { return path.empty() ? name : path + "/" + name; }

/// True if all of the text is a number of this type.
template <class Number>
bool reads(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && last == end;
}

/// A value of a command line has no type: its look gives one.
void set_by_look(Teuchos::ParameterList& list, const std::string& name, const std::string& text) {
  int whole = 0;
  double number = 0.0;
  if (text == "true" || text == "false")
    list.set(name, text == "true");
  else if (reads(text, whole))
    list.set(name, whole);
  else if (reads(text, number))
    list.set(name, number);
  else
    list.set(name, text);
}

Teuchos::ParameterList to_teuchos(const XmlList& list, const Symbols& symbols, std::vector<Diagnostic>& diagnostics) {
  Teuchos::ParameterList result(list.name);
  for (const XmlParameter& one : list.parameters) {
    try {
      if (one.type.empty()) {
        set_by_look(result, one.name, one.value);
      } else if (one.type == "bool") {
        if (one.value != "true" && one.value != "false")
          throw InputError(one.place, fmt::format("\"{}\" is \"{}\"; please write true or false", one.name, one.value));
        result.set(one.name, one.value == "true");
      } else if (one.type == "int" || one.type == "double") {
        const double value = parse_expression({}, one.value, symbols, one.place)();
        if (one.type == "double") {
          result.set(one.name, value);
        } else {
          const auto whole = whole_number<int>(value);
          if (!whole)
            throw InputError(one.place, fmt::format("\"{}\" is \"{}\"; an int has to be whole, from -2147483648 to 2147483647", one.name, one.value));
          result.set(one.name, *whole);
        }
      } else {
        result.set(one.name, one.value);
      }
    } catch (const InputError& error) {
      diagnostics.insert(diagnostics.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  for (const XmlList& one : list.lists) result.sublist(one.name) = to_teuchos(one, symbols, diagnostics);
  return result;
}

void collect(const XmlList& list, const std::string& path, std::vector<Assignment>& assignments) {
  for (const XmlParameter& one : list.parameters) assignments.push_back({joined_path(path, one.name), one.value, one.place});
  for (const XmlList& one : list.lists) collect(one, joined_path(path, one.name), assignments);
}

}  // namespace

ReadParameters::ReadParameters(const XmlList& root, const Symbols& symbols, const std::vector<std::string>& ignored) : symbols_(symbols) {
  frames_.push_back({"", &root, root.place, ignored});
}

Place ReadParameters::place(const std::string& name) const {
  if (!frame().list) return frame().place;
  if (const XmlParameter* parameter = frame().list->parameter(name)) return parameter->place;
  const XmlList* list = frame().list->list(name);
  return list ? list->place : frame().place;
}

// A message that begins with a name says itself what it is about. One about a parameter that was refused would be about the default in its place.
void ReadParameters::error(const std::string& name, const std::string& message) {
  const auto names = [](const std::string& text, const std::string& one) { return text.find('"' + one + '"') != std::string::npos; };
  const bool named = name.empty() || message.front() == '"' || names(message, name);
  const std::string text = named ? message : '"' + name + "\": " + message;
  for (const auto& path : frame().refused)
    if (std::all_of(path.begin(), path.end(), [&](const std::string& one) { return names(text, one); })) return;
  say(place(name), text);
}

void ReadParameters::refuse(const std::string& name, const Place& where, const std::string& message) {
  frame().refused.push_back({name});
  say(where, message);
}

void ReadParameters::refuse(const std::string& name, const InputError& error) {
  frame().refused.push_back({name});
  for (const Diagnostic& one : error.diagnostics()) say(one.place, fmt::format("\"{}\": {}", name, one.message));
}

void ReadParameters::know(const std::string& name, const Says& says) {
  frame().known.push_back(name);
  if (!says.former().empty()) frame().renamed[says.former()] = name;
}

const XmlParameter* ReadParameters::find(const std::string& name, const Says& says, const std::vector<std::string>& types) {
  know(name, says);
  const XmlParameter* parameter = frame().list ? frame().list->parameter(name) : nullptr;
  if (!parameter) {
    if (frame().list && frame().list->list(name)) {
      refuse(name, frame().list->list(name)->place, fmt::format("\"{}\" is a parameter, not a list: {}", name, says.sentence()));
    } else if (says.is_required()) {
      refuse(name, frame().place, fmt::format("\"{}\" is missing; please add it: {}", name, says.sentence()));
    }
    return nullptr;
  }
  // An empty type is the command line's; a string may hold an expression for any kind.
  if (!parameter->type.empty() && parameter->type != "string" && std::find(types.begin(), types.end(), parameter->type) == types.end()) {
    refuse(name, parameter->place, fmt::format("parameter \"{}\" has type \"{}\"; please give {}", name, parameter->type, quoted_list(types)));
    return nullptr;
  }
  return parameter;
}

std::optional<double> ReadParameters::number(const XmlParameter& parameter, const std::string& text, const Says& says) {
  try {
    const double value = parse_expression({}, text, symbols_, parameter.place)();
    if (is_in_range(value, says)) return value;
    refuse(parameter.name, parameter.place, fmt::format("\"{}\" is {}; allowed: {}", parameter.name, value, range_text(says)));
  } catch (const InputError& error) {
    refuse(parameter.name, error);
  }
  return std::nullopt;
}

void ReadParameters::add(const std::string& name, double& value, const Says& says) {
  if (const XmlParameter* parameter = find(name, says, {"double", "int"}))
    if (const auto read = number(*parameter, parameter->value, says)) value = *read;
}

void ReadParameters::add(const std::string& name, std::optional<double>& value, const Says& says) {
  if (const XmlParameter* parameter = find(name, says, {"double", "int"}))
    if (const auto read = number(*parameter, parameter->value, says)) value = *read;
}

void ReadParameters::add(const std::string& name, int& value, const Says& says) {
  const XmlParameter* parameter = find(name, says, {"int"});
  if (!parameter) return;
  const auto read = number(*parameter, parameter->value, says);
  if (!read) return;
  if (const auto whole = whole_number<int>(*read))
    value = *whole;
  else
    refuse(name, parameter->place, fmt::format("\"{}\" is {}; it has to be a whole number", name, *read));
}

void ReadParameters::add(const std::string& name, bool& value, const Says& says) {
  const XmlParameter* parameter = find(name, says, {"bool"});
  if (!parameter) return;
  if (parameter->value == "true" || parameter->value == "false")
    value = parameter->value == "true";
  else
    refuse(name, parameter->place, fmt::format("\"{}\" is \"{}\"; please write true or false", name, parameter->value));
}

void ReadParameters::add(const std::string& name, std::string& value, const Says& says) {
  const XmlParameter* parameter = find(name, says, {"string"});
  if (!parameter) return;
  if (says.is_required() && parameter->value.empty()) refuse(name, parameter->place, fmt::format("\"{}\" is empty", name));
  value = parameter->value;
}

void ReadParameters::add(const std::string& name, ScalarFunction& value, const Says& says) {
  const XmlParameter* parameter = find(name, says, {"double", "int"});
  if (!parameter) return;
  try {
    const bool usual = says.arguments().empty();
    ScalarFunction read = usual ? parse_expression(parameter->value, symbols_, parameter->place)
                                : parse_expression(says.arguments(), parameter->value, symbols_, parameter->place);
    if (read.is_constant() && !is_in_range(read(), says))
      refuse(name, parameter->place, fmt::format("\"{}\" is {}; allowed: {}", name, read(), range_text(says)));
    else
      value = std::move(read);
  } catch (const InputError& error) {
    refuse(name, error);
  }
}

void ReadParameters::add(const std::string& name, std::optional<ScalarFunction>& value, const Says& says) {
  if (!frame().list || !frame().list->parameter(name)) {
    know(name, says);
    return;
  }
  ScalarFunction read;
  add(name, read, says);
  value = std::move(read);
}

void ReadParameters::add(const std::string& name, std::vector<double>& value, const Says& says) {
  const XmlParameter* parameter = find(name, says, {"double", "int"});
  if (!parameter) return;
  std::vector<double> all;
  for (const std::string& part : split(parameter->value)) {
    const auto read = number(*parameter, part, says);
    if (!read) return;
    all.push_back(*read);
  }
  value = std::move(all);
}

void ReadParameters::add(const std::string& name, std::vector<std::string>& value, const Says& says) {
  if (const XmlParameter* parameter = find(name, says, {"string"})) value = split(parameter->value);
}

void ReadParameters::add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) {
  const XmlParameter* parameter = find(name, says, {"string"});
  if (!parameter) return;
  const auto found = std::find(names.begin(), names.end(), parameter->value);
  if (found == names.end())
    refuse(name, parameter->place,
           fmt::format("\"{}\" is \"{}\"; allowed: {}{}", name, parameter->value, quoted_list(names), did_you_mean(parameter->value, names)));
  else
    index = static_cast<std::size_t>(found - names.begin());
}

void ReadParameters::verbatim(const std::string& name, Teuchos::ParameterList& list, const Says& says) {
  know(name, says);
  if (const XmlList* given = frame().list ? frame().list->list(name) : nullptr) list.setParameters(to_teuchos(*given, symbols_, diagnostics_));
}

void ReadParameters::assignments(std::vector<Assignment>& assignments) {
  frame().check_unknown = false;
  if (frame().list) collect(*frame().list, "", assignments);
}

bool ReadParameters::begin_list(const std::string& name, const Says& says) {
  know(name, says);
  if (frame().list && frame().list->parameter(name)) say(place(name), fmt::format("\"{}\" is a list, not a parameter: {}", name, says.sentence()));
  const XmlList* given = frame().list ? frame().list->list(name) : nullptr;
  Place where = given ? given->place : frame().place;
  if (!given) where.path = joined_path(where.path, name);
  frames_.push_back({name, given, where});
  return true;
}

void ReadParameters::end_list() {
  report_unknown(frame());
  const Frame inner = std::move(frames_.back());
  frames_.pop_back();
  for (auto path : inner.refused) {
    path.insert(path.begin(), inner.name);
    frame().refused.push_back(std::move(path));
  }
}

void ReadParameters::named_lists(const std::string& name, const NamedAccess& access, const Says& says) {
  know(name, says);
  if (frame().list && frame().list->parameter(name)) say(place(name), fmt::format("\"{}\" is a list, not a parameter: {}", name, says.sentence()));
  const XmlList* given = frame().list ? frame().list->list(name) : nullptr;
  if (!given) {
    if (says.is_required()) say(frame().place, fmt::format("the list \"{}\" is missing; please add it: {}", name, says.sentence()));
    return;
  }
  for (const XmlParameter& parameter : given->parameters)
    say(parameter.place, fmt::format("unknown parameter \"{}\"; the list \"{}\" holds lists with names of your choice", parameter.name, name));
  for (const XmlList& entry : given->lists) {
    access.append(entry.name, entry.place);
    frames_.push_back({entry.name, &entry, entry.place});
    access.describe(access.size() - 1, *this);
    end_list();
  }
}

void ReadParameters::choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) {
  std::vector<std::string> kinds;
  for (const auto& kind : access.kinds) kinds.push_back(kind.first);
  know(name, says);
  const XmlParameter* parameter = frame().list ? frame().list->parameter(name) : nullptr;
  if (!parameter && !access.type.empty()) {
    access.describe(*this);
    return;
  }
  if (!parameter) {
    frame().check_unknown = false;
    say(frame().place, fmt::format("\"{}\" is missing; please add it: {}; one of {}", name, says.sentence(), quoted_list(kinds)));
    return;
  }
  const auto found = std::find(kinds.begin(), kinds.end(), parameter->value);
  if (found == kinds.end()) {
    frame().check_unknown = false;  // what else stands here belongs to a kind nobody knows
    say(parameter->place,
        fmt::format("\"{}\" is \"{}\"; allowed: {}{}", name, parameter->value, quoted_list(kinds), did_you_mean(parameter->value, kinds)));
    return;
  }
  access.select(static_cast<std::size_t>(found - kinds.begin()), parameter->place);
  access.describe(*this);
}

void ReadParameters::report_unknown(const Frame& frame) {
  if (!frame.list || !frame.check_unknown) return;
  const auto unknown = [&](const Place& place, const char* what, const std::string& name) {
    if (std::find(frame.known.begin(), frame.known.end(), name) != frame.known.end()) return;
    const auto present = frame.renamed.find(name);
    std::string hint = present == frame.renamed.end() ? did_you_mean(name, frame.known) : fmt::format("; it is called \"{}\" now", present->second);
    if (hint.empty()) hint = "; known here: " + quoted_list(frame.known);
    say(place, fmt::format("unknown {} \"{}\"{}", what, name, hint));
  };
  for (const XmlParameter& parameter : frame.list->parameters) unknown(parameter.place, "parameter", parameter.name);
  for (const XmlList& list : frame.list->lists) unknown(list.place, "list", list.name);
}

std::vector<Diagnostic> ReadParameters::finish() {
  report_unknown(frame());
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) { return a.place.line < b.place.line; });
  return diagnostics_;
}

}  // namespace mortise
