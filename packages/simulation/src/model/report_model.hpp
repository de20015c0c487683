#pragma once
// What a run consists of, as people read it.

#include <string>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"

namespace mortise {

/// Effects first, then sizes. Collective.
void report_model(const std::string& file, const Scene& scene, const Model& model, RunLog& log);

/// What a run of the model will take, roughly, and a warning where that is more than there is. Collective.
void report_memory(const Model& model, RunLog& log);

}  // namespace mortise
