#include "shared/throw_all.hpp"

#include <algorithm>
#include <set>
#include <string>

namespace mortise {

void throw_all(std::vector<Diagnostic> diagnostics) {
  if (diagnostics.empty()) return;
  std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const auto& a, const auto& b) { return a.place.line < b.place.line; });
  std::set<std::string> said;
  std::vector<Diagnostic> once;
  for (const auto& one : diagnostics)
    if (said.insert(to_string(one)).second) once.push_back(one);
  throw InputError(once);
}

}  // namespace mortise
