#pragma once
// Log of the corners of slave surfaces.

#include "mortise/contact/contact_system.hpp"
#include "mortise/simulation/model/run_log.hpp"

namespace mortise {

/// Names the pairs whose slave surface has kinks, and the rule that gives these their normals. Collective.
void report_corners(const ContactSystem& contact, const ContactEvaluation& at_start, RunLog& log);

}  // namespace mortise
