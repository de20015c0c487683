#pragma once
// Warns of contact that cannot come about.

#include "mortise/simulation/model.hpp"
#include "run_log.hpp"

namespace mortise {

/// Collective. One warning for each pair whose master turns its back on the slave in the reference configuration.
void warn_of_turned_masters(const Model& model, const Scene& scene, RunLog& log);

}  // namespace mortise
