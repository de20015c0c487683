#pragma once
// Content of a run's summary.json.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/run/output/exit_code.hpp"
#include "mortise/simulation/scene/checks.hpp"

namespace mortise {

/// Everything that happened, gathered while the run goes on.
struct RunRecord {
  std::string scene, version;
  std::vector<std::string> settings;  ///< "path=value" of the command line
  bool converged = false;
  ExitCode exit = ExitCode::internal;
  int steps = 0;                             ///< accepted
  double time = 0.0;                         ///< of the last of them
  long long newton_steps = 0;                ///< of all of them
  std::optional<std::string> reason;         ///< why a step found no solution; else what could not be written at the end
  std::optional<std::string> stopped;        ///< reason why it stopped before its end: a signal, the time limit
  std::vector<std::string> parts;            ///< JSON of each process that this run was made by; the last of them is this one
  std::map<std::string, double> quantities;  ///< at the end
  std::vector<std::string> quantity_order;
  std::vector<CheckResult> checks;
  std::vector<std::pair<std::string, IntegrationLoad>> integration;  ///< by contact pair
  std::map<std::string, double> seconds;                             ///< by timer, mean over the ranks
  double memory_peak_mib = 0.0;                                      ///< of the rank that took most
  double memory_total_mib = 0.0;                                     ///< sum of the peaks of all ranks

  /// Stores or restores what the steps have left here.
  void serialize(StateArchive& archive);
};

/// A finished step as one line of JSON, without its end.
std::string step_line(const StepReport& step);

/// Description of a process that makes a run: from which step it starts, on how many ranks, where and when. As JSON.
std::string part_text(int from_step, int ranks);

/// The summary with the names that docs/output.md lists, on rank 0. Collective.
/// @param steps  file of the lines of all finished steps
nlohmann::ordered_json summary(const RunRecord& record, const Model& model, const std::optional<ContactHistory>& contact, const std::string& steps);

}  // namespace mortise
