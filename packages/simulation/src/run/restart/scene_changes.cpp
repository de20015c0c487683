#include "run/restart/scene_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <sstream>

#include "mortise/input/parameter_tree.hpp"

namespace mortise {
namespace {

using Lines = std::map<std::string, std::string>;

/// Suffix of an expression: the symbols that it names, with their values.
std::string named_symbols(const std::string& expression, const std::map<std::string, std::string>& symbols) {
  std::string result;
  std::set<std::string> named;
  for (std::size_t begin = 0; begin < expression.size();) {
    const auto is_word = [&](std::size_t at) { return std::isalnum(static_cast<unsigned char>(expression[at])) != 0 || expression[at] == '_'; };
    std::size_t end = begin;
    while (end < expression.size() && is_word(end)) ++end;
    if (const auto found = symbols.find(expression.substr(begin, end - begin)); found != symbols.end() && named.insert(found->first).second)
      result += fmt::format(" [{} = {}]", found->first, found->second);
    begin = std::max(end, begin + 1);
  }
  return result;
}

std::map<std::string, std::string> symbol_texts(const Symbols& symbols) {
  std::map<std::string, std::string> texts;
  for (const ListRecord& list : symbol_lists(symbols)) {
    for (const ParameterRecord& one : list.parameters) texts[one.name] = one.value;
    for (const ListRecord& table : list.lists)
      for (const ParameterRecord& one : table.parameters) texts[table.name] += fmt::format("{}: {}; ", one.name, one.value);
  }
  return texts;
}

void collect_lines(const ListRecord& list, const std::string& path, const std::map<std::string, std::string>& symbols, std::ostringstream& lines) {
  for (const ParameterRecord& one : list.parameters) {
    std::string value = one.value;
    std::replace(value.begin(), value.end(), '\n', ' ');
    const bool is_expression = one.kind == ParameterRecord::Kind::expression || one.kind == ParameterRecord::Kind::optional_expression;
    lines << path << one.name << " = " << value << (is_expression ? named_symbols(value, symbols) : "") << '\n';
  }
  for (const ListRecord& inner : list.lists) collect_lines(inner, path + inner.name + "/", symbols, lines);
  for (const auto& [kind, parameters] : list.kinds) collect_lines(parameters, path, symbols, lines);
  if (list.kind == ListRecord::Kind::verbatim) {
    std::ostringstream text;
    list.verbatim.print(text, Teuchos::ParameterList::PrintOptions().showDoc(false));
    std::string value = text.str();
    std::replace(value.begin(), value.end(), '\n', ' ');
    lines << path << " = " << value << '\n';
  }
}

Lines lines_of(const std::string& fingerprint) {
  Lines lines;
  std::istringstream text(fingerprint);
  for (std::string line; std::getline(text, line);)
    if (const std::size_t equal = line.find(" = "); equal != std::string::npos) lines[line.substr(0, equal)] = line.substr(equal + 3);
  return lines;
}

constexpr std::array<const char*, 6> free_lists{"stepping/", "newton/", "linear solver/", "output/", "checks/", "loads/"};

/// Values of boundary conditions may change, which components are prescribed may not; likewise prescribed temperatures and thermal loads. Of contact
/// that may which only says who works where.
bool may_differ(const std::string& path, const std::string& before, const std::string& now) {
  for (const char* list : free_lists)
    if (path.compare(0, std::string(list).size(), list) == 0) return true;
  const std::string name = path.substr(path.rfind('/') + 1);
  if (path.compare(0, 8, "contact/") == 0 && name == "balance") return true;
  const bool is_kept = !before.empty() && !now.empty();
  if (path.compare(0, 18, "heat/temperatures/") == 0 && name == "temperature" && is_kept) return true;
  if (path.compare(0, 11, "heat/loads/") == 0 && name != "type" && name != "set" && is_kept) return true;
  const bool is_value = name == "x" || name == "y" || name == "z" || name.compare(0, 8, "rotation") == 0;
  return path.compare(0, 20, "boundary conditions/") == 0 && is_value && is_kept;
}

}  // namespace

std::string scene_fingerprint(const Scene& scene) {
  std::ostringstream lines;
  collect_lines(collect_parameters(scene.name, scene, CollectParameters::What::values), "", symbol_texts(scene.symbols), lines);
  return lines.str();
}

std::string what_may_change() {
  return "\"stepping\", \"newton\", \"linear solver\", \"output\", \"checks\", \"balance\" of contact, and the \"loads\", and the values of "
         "\"boundary conditions\", prescribed temperatures and thermal loads after the time of the checkpoint";
}

std::vector<std::string> refused_changes(const std::string& fingerprint_before, const std::string& fingerprint_now) {
  const Lines before = lines_of(fingerprint_before), now = lines_of(fingerprint_now);
  std::vector<std::string> refused;
  for (const auto& [path, value] : before) {
    const auto found = now.find(path);
    const std::string other = found == now.end() ? "" : found->second;
    if ((found == now.end() || other != value) && !may_differ(path, value, other))
      refused.push_back(found == now.end() ? fmt::format("\"{}\" is missing; it was {}", path, shortened(value))
                                           : fmt::format("\"{}\" is {}; it was {}", path, shortened(other), shortened(value)));
  }
  for (const auto& [path, value] : now)
    if (before.find(path) == before.end() && !may_differ(path, "", value))
      refused.push_back(fmt::format("\"{}\" is new: {}", path, shortened(value)));
  return refused;
}

}  // namespace mortise
