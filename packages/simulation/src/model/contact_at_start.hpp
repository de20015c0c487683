#pragma once
// Report on contact before anything has moved.

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/run_log.hpp"

namespace mortise {

/// Logs a line for each pair: how deep its surfaces overlap and where, or how far apart they are. Warns of an overlap that is deeper than
/// a facet, and of bodies that overlap without a pair.
void report_contact_at_start(const Model& model, const Scene& scene, RunLog& log);

}  // namespace mortise
