#pragma once
// Time and memory of a run on a machine, from what its ranks would hold and do.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mortise/studies/machine_file.hpp"
#include "scale/scale_plan.hpp"

namespace mortise {

/// Work of a phase: of the rank that has most, and of all.
struct PhaseWork {
  double most = 0.0, whole = 0.0;
};

/// Work of all phases for one count of each, [scale_phases()].
std::vector<PhaseWork> work_of(const ScalePlan& plan);

/// How many times as long a rank takes to stream its matrices as alone, with so many ranks on a machine of several nodes. 1 where bandwidths are
/// not known.
double slowdown(const MachineFile& machine, int ranks);

/// Time, memory and cost of a run.
struct ScalePrediction {
  int ranks = 1, nodes = 1;
  std::vector<double> phases;  ///< [scale_phases()] seconds; empty without rates
  double seconds = 0.0;
  double memory_per_node = 0.0;  ///< MiB, of the node that takes most
  double core_seconds = 0.0;     ///< of whole nodes
  bool fits = true;              ///< in the memory of its nodes
};

ScalePrediction predict(const MachineFile& machine, const ScalePlan& plan);

/// Numbers of ranks up to `most` that are worth a prediction: powers of two, whole nodes and `most`.
std::vector<int> candidate_ranks(const MachineFile& machine, int most);

/// The prediction with the fewest core seconds among those that fit, the fastest of them if several have; null if none fits or there are no times.
const ScalePrediction* cheapest(const std::vector<ScalePrediction>& predictions);

/// The predictions and the cheapest one, for plan.json.
nlohmann::ordered_json prediction_json(const MachineFile& machine, const std::vector<ScalePrediction>& predictions);

/// A table of them for the screen, a line each, and a sentence on the cheapest.
std::vector<std::string> prediction_lines(const MachineFile& machine, const std::vector<ScalePrediction>& predictions);

}  // namespace mortise
