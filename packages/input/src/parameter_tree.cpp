#include "mortise/input/parameter_tree.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>

#include "mortise/core/names.hpp"
#include "mortise/input/expression.hpp"

namespace mortise {

using Kind = ParameterRecord::Kind;

std::string ParameterRecord::type() const {
  switch (kind) {
    case Kind::number:
    case Kind::optional_number:
      return "double";
    case Kind::integer:
      return "int";
    case Kind::boolean:
      return "bool";
    default:
      return "string";
  }
}

std::string ParameterRecord::kind_text() const {
  switch (kind) {
    case Kind::number:
    case Kind::optional_number:
      return "number";
    case Kind::integer:
      return "whole number";
    case Kind::boolean:
      return "true or false";
    case Kind::text:
      return "text";
    case Kind::expression:
    case Kind::optional_expression:
      return says.arguments().empty() ? "expression of t, x, y, z" : fmt::format("expression of {}", fmt::join(says.arguments(), ", "));
    case Kind::numbers:
      return "numbers, separated by commas";
    case Kind::texts:
      return "names, separated by commas";
    case Kind::enumeration:
      return "one of " + quoted_list(choices);
  }
  return "";
}

std::string ParameterRecord::range_text() const {
  std::string text;
  if (says.lower()) text = fmt::format("{} {}", says.lower_open() ? ">" : ">=", *says.lower());
  if (says.upper()) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", says.upper_open() ? "<" : "<=", *says.upper());
  return text;
}

CollectParameters::CollectParameters(std::string name, What what) : what_(what) {
  stack_.emplace_back();
  here().name = std::move(name);
}

void CollectParameters::record(const std::string& name, Kind kind, std::string value, const Says& says, std::vector<std::string> choices) {
  here().parameters.push_back({name, kind, std::move(value), says, std::move(choices)});
}

void CollectParameters::add(const std::string& name, double& value, const Says& says) { record(name, Kind::number, fmt::format("{}", value), says); }
void CollectParameters::add(const std::string& name, int& value, const Says& says) { record(name, Kind::integer, fmt::format("{}", value), says); }
void CollectParameters::add(const std::string& name, bool& value, const Says& says) { record(name, Kind::boolean, value ? "true" : "false", says); }
void CollectParameters::add(const std::string& name, std::string& value, const Says& says) { record(name, Kind::text, value, says); }
void CollectParameters::add(const std::string& name, ScalarFunction& value, const Says& says) {
  record(name, Kind::expression, value.source(), says);
}
void CollectParameters::add(const std::string& name, std::optional<double>& value, const Says& says) {
  record(name, Kind::optional_number, value ? fmt::format("{}", *value) : "", says);
}
void CollectParameters::add(const std::string& name, std::optional<ScalarFunction>& value, const Says& says) {
  record(name, Kind::optional_expression, value ? value->source() : "", says);
}
void CollectParameters::add(const std::string& name, std::vector<double>& value, const Says& says) {
  record(name, Kind::numbers, fmt::format("{}", fmt::join(value, ", ")), says);
}
void CollectParameters::add(const std::string& name, std::vector<std::string>& value, const Says& says) {
  record(name, Kind::texts, fmt::format("{}", fmt::join(value, ", ")), says);
}
void CollectParameters::add_enumeration(const std::string& name, std::size_t& index, const std::vector<std::string>& names, const Says& says) {
  record(name, Kind::enumeration, names[index], says, names);
}

void CollectParameters::verbatim(const std::string& name, Teuchos::ParameterList& list, const Says& says) {
  ListRecord record;
  record.name = name;
  record.says = says;
  record.kind = ListRecord::Kind::verbatim;
  record.verbatim = list;
  here().lists.push_back(std::move(record));
}

void CollectParameters::assignments(std::vector<Assignment>& assignments) {
  here().kind = ListRecord::Kind::verbatim;
  for (const Assignment& one : assignments) here().verbatim.set(one.path, one.value);
}

bool CollectParameters::begin_list(const std::string& name, const Says& says) {
  stack_.emplace_back();
  here().name = name;
  here().says = says;
  return true;
}

void CollectParameters::end_list() {
  ListRecord finished = std::move(stack_.back());
  stack_.pop_back();
  here().lists.push_back(std::move(finished));
}

void CollectParameters::named_lists(const std::string& name, const NamedAccess& access, const Says& says) {
  if (what_ == What::values && access.size() == 0) return;
  begin_list(name, says);
  here().kind = ListRecord::Kind::named;
  if (what_ == What::declarations) {
    begin_list("<name>", Says("one of them, by a name of your choice"));
    access.describe_prototype(*this);
    end_list();
  } else {
    for (std::size_t i = 0; i < access.size(); ++i) {
      begin_list(access.name(i), Says(""));
      access.describe(i, *this);
      end_list();
    }
  }
  end_list();
}

void CollectParameters::choice_of(const std::string& name, const ChoiceAccess& access, const Says& says) {
  std::vector<std::string> names;
  for (const auto& kind : access.kinds) names.push_back(kind.first);
  Says required = says;
  if (access.type.empty()) required.required();
  record(name, Kind::enumeration, access.type, required, names);
  if (what_ == What::values) {
    if (!access.type.empty()) access.describe(*this);
    return;
  }
  for (std::size_t i = 0; i < access.kinds.size(); ++i) {
    stack_.emplace_back();
    here().name = access.kinds[i].first;
    here().says = Says(access.kinds[i].second);
    access.describe_prototype(i, *this);
    ListRecord kind = std::move(stack_.back());
    stack_.pop_back();
    here().kinds.push_back({access.kinds[i].first, std::move(kind)});
  }
}

const ListRecord* find_list(const ListRecord& tree, const std::string& path) {
  const ListRecord* list = &tree;
  std::istringstream stream(path);
  for (std::string name; std::getline(stream, name, '/');) {
    const ListRecord* next = nullptr;
    for (const ListRecord& one : list->lists)
      if (one.name == name || (list->kind == ListRecord::Kind::named && one.name == "<name>")) next = &one;
    for (const auto& [kind, record] : list->kinds)
      if (kind == name) next = &record;
    if (!next) return nullptr;
    list = next;
  }
  return list;
}

std::vector<ListRecord> symbol_lists(const Symbols& symbols) {
  std::vector<ListRecord> lists;
  if (!symbols.variables.empty()) {
    ListRecord variables;
    variables.name = "variables";
    for (const auto& [name, value] : symbols.variables) variables.parameters.push_back({name, Kind::number, fmt::format("{}", value), Says(""), {}});
    lists.push_back(std::move(variables));
  }
  if (!symbols.tables.empty()) {
    ListRecord tables;
    tables.name = "tables";
    for (const auto& [name, table] : symbols.tables) {
      ListRecord one;
      one.name = name;
      one.parameters.push_back({"times", Kind::numbers, fmt::format("{}", fmt::join(table.times, ", ")), Says(""), {}});
      one.parameters.push_back({"values", Kind::numbers, fmt::format("{}", fmt::join(table.values, ", ")), Says(""), {}});
      tables.lists.push_back(std::move(one));
    }
    lists.push_back(std::move(tables));
  }
  return lists;
}

}  // namespace mortise
