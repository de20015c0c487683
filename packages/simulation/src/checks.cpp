#include "mortise/simulation/checks.hpp"

#include <fmt/format.h>

#include "names.hpp"

namespace mortise {

void CheckOptions::describe(Parameters& parameters) {
  parameters.add("quantity", quantity, Says("name of one of the scene's quantities").required());
  parameters.add("low", low, "the least value allowed at the end; default: no bound");
  parameters.add("high", high, "the largest value allowed at the end; default: no bound");
  if (!low && !high) parameters.error("quantity", "a check without a bound; please add \"low\" or \"high\"");
  if (low && high && *low > *high) parameters.error("high", fmt::format("is {:g}, below \"low\", {:g}", *high, *low));
}

std::vector<CheckResult> evaluate_checks(const std::vector<Named<CheckOptions>>& checks, const std::map<std::string, double>& values) {
  std::vector<std::string> known;
  for (const auto& value : values) known.push_back(value.first);
  std::vector<Diagnostic> diagnostics;
  std::vector<CheckResult> results;
  for (const auto& check : checks) {
    const auto& options = check.value;
    const auto found = values.find(options.quantity.value);
    if (found == values.end()) {
      diagnostics.push_back({options.quantity.place, unknown_name("quantity", options.quantity.value, known)});
      continue;
    }
    const double value = found->second;
    const bool ok = value == value && (!options.low || value >= *options.low) && (!options.high || value <= *options.high);
    results.push_back({check.name, options.quantity.value, value, options.low, options.high, ok});
  }
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return results;
}

}  // namespace mortise
