#pragma once
// Bounds on quantities.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// A bound on a quantity at the end of a run.
struct CheckOptions {
  Located<std::string> quantity;
  std::optional<double> low, high;  ///< at least one
  void describe(Parameters& parameters);
};

/// Result of a check: a row of summary.json.
struct CheckResult {
  std::string name, quantity;
  double value = 0.0;
  std::optional<double> low, high;
  bool ok = false;  ///< low <= value <= high; never for a value that is not a number
};

/// One row for each check, in their order. Throws InputError for all quantities that are not among `values`, with the nearest names.
std::vector<CheckResult> evaluate_checks(const std::vector<Named<CheckOptions>>& checks, const std::map<std::string, double>& values);

/// "check on the cone: 0.1999998 <= force_ratio <= 0.2000002: 0.2: ok", with the digits that tell bounds and value apart.
std::string check_line(const CheckResult& check);

}  // namespace mortise
