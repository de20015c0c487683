#pragma once
// What a run consists of, as people read it.

#include <string>

#include "mortise/simulation/model.hpp"
#include "run_log.hpp"

namespace mortise {

/// Effects first, then sizes. Collective.
void report_model(const std::string& file, const Scene& scene, const Model& model, RunLog& log);

/// MiB over all ranks.
struct MemoryEstimate {
  double so_far = 0.0;          ///< largest size until now, with the program and its libraries
  double linear_systems = 0.0;  ///< what the linear systems will take at their largest, by the solver of the model: rough
};

/// What a run of the model will take. Collective.
MemoryEstimate estimated_memory(const Model& model);

}  // namespace mortise
