#pragma once
// Report on the parts of a run, for people.

#include <string>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"

namespace mortise {

/// Effects first, then sizes. Collective.
void report_model(const std::string& file, const Scene& scene, const Model& model, RunLog& log);

/// Reports the memory that a run of the model will take, roughly, with a warning where that is more than there is. Collective.
void report_memory(const Model& model, RunLog& log);

}  // namespace mortise
