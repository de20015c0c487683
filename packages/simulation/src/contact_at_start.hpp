#pragma once
// What can be said of contact before anything has moved.

#include "mortise/simulation/model.hpp"
#include "run_log.hpp"

namespace mortise {

/// Collective. Of each pair in the reference configuration: a warning if its master turns its back on the slave, a line if the surfaces overlap.
void report_contact_at_start(const Model& model, const Scene& scene, RunLog& log);

}  // namespace mortise
