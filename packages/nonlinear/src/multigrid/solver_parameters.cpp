#include "multigrid/solver_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "mortise/core/names.hpp"

namespace mortise::detail {

std::vector<Diagnostic> unknown_parameters(const Teuchos::ParameterList& given, const Teuchos::ParameterList& valid, const Place& place,
                                           const std::string& owner, const std::string& listed, const std::string& levels) {
  std::vector<std::string> names;
  for (const auto& entry : valid) names.push_back(entry.first);
  std::vector<Diagnostic> found;
  for (const auto& item : given) {
    const std::string& name = item.first;
    if (!levels.empty() && item.second.isList() && name.rfind(levels, 0) == 0) {
      const auto within = unknown_parameters(given.sublist(name), valid, place, owner, listed);
      found.insert(found.end(), within.begin(), within.end());
    } else if (!valid.isParameter(name)) {
      const std::string hint = did_you_mean(name, names);
      found.push_back({place, fmt::format("\"{}\" is no parameter of {}{} They are listed in {}", name, owner, hint.empty() ? "." : hint, listed)});
    }
  }
  return found;
}

std::string in_one_line(const std::string& message) {
  std::istringstream lines(message.substr(std::min(message.find("Error, "), message.size())));
  std::string text, line;
  while (std::getline(lines, line)) {
    if (line.rfind("The valid parameters", 0) == 0) break;
    if (line.empty() || line.rfind("Throw ", 0) == 0) continue;
    text += (text.empty() ? "" : " ") + line;
  }
  return text.empty() ? message : text;
}

}  // namespace mortise::detail
