#include "mortise/simulation/scene/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mortise/core/names.hpp"

namespace mortise {
namespace {

/// True if numbers that differ are written differently with so many digits, of which a value has ten at least.
bool tells_apart(const CheckResult& check, int digits) {
  const auto differ = [&](double bound, double other, int digits_of_other) {
    return bound == other || fmt::format("{:.{}g}", bound, digits) != fmt::format("{:.{}g}", other, digits_of_other);
  };
  for (const auto& bound : {check.low, check.high})
    if (bound && !differ(*bound, check.value, std::max(digits, 10))) return false;
  return !check.low || !check.high || differ(*check.low, *check.high, digits);
}

}  // namespace

void CheckOptions::describe(Parameters& parameters) {
  parameters.add("quantity", quantity, Says("name of one of the scene's quantities").required());
  parameters.add("low", low, "the least value allowed at the end; default: no bound");
  parameters.add("high", high, "the largest value allowed at the end; default: no bound");
  if (!low && !high) parameters.error("quantity", "a check without a bound; please add \"low\" or \"high\"");
  if (low && high && *low > *high) parameters.error("high", fmt::format("is {}, below \"low\", {}", *high, *low));
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

std::string check_line(const CheckResult& check) {
  int digits = 6;
  while (digits < std::numeric_limits<double>::max_digits10 && !tells_apart(check, digits)) ++digits;
  const std::string low = check.low ? fmt::format("{:.{}g} <= ", *check.low, digits) : "";
  const std::string high = check.high ? fmt::format(" <= {:.{}g}", *check.high, digits) : "";
  return fmt::format("check {}: {}{}{}: {:.{}g}: {}", check.name, low, check.quantity, high, check.value, std::max(digits, 10),
                     check.ok ? "ok" : "MISSED");
}

}  // namespace mortise
