#pragma once
// What a run consists of, as people read it.

#include <string>

#include "mortise/simulation/model.hpp"
#include "run_log.hpp"

namespace mortise {

/// Effects first, then sizes. Collective.
void report_model(const std::string& file, const Scene& scene, const Model& model, RunLog& log);

/// Rough size in MiB, over all ranks, of what a run with a direct solver holds at its largest.
double estimated_memory_mib(const Model& model);

}  // namespace mortise
