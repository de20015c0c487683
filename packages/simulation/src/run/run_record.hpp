#pragma once
// What a run leaves in summary.json.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/run/exit_code.hpp"
#include "mortise/simulation/scene/checks.hpp"

namespace mortise {

/// Everything that happened, gathered while the run goes on.
struct RunRecord {
  std::string scene, version;
  std::vector<std::string> settings;  ///< "path=value" of the command line
  bool converged = false;
  ExitCode exit = ExitCode::internal;
  std::vector<StepReport> steps;
  std::map<std::string, double> quantities;  ///< at the end
  std::vector<std::string> quantity_order;
  std::vector<CheckResult> checks;
  std::vector<std::pair<std::string, IntegrationLoad>> integration;  ///< by contact pair
  std::map<std::string, double> seconds;                             ///< by timer, mean over the ranks
  double memory_peak_mib = 0.0;                                      ///< of the rank that took most
  double memory_total_mib = 0.0;                                     ///< sum of the peaks of all ranks
};

/// The summary with the names that docs/output.md lists. Collective.
nlohmann::ordered_json summary(const RunRecord& record, const Model& model, const std::optional<ContactHistory>& contact);

}  // namespace mortise
