#pragma once
// A line for each point of a study.

#include <optional>
#include <vector>

#include "mortise/simulation/model/run_log.hpp"
#include "study/study_record.hpp"

namespace mortise {

/// Says how `points[number]` ended and about how long those without a record take. Each counts as long as others with the same value of the axis
/// "along", which decides most on the cost.
void log_progress(const StudyPlan& plan, const std::vector<StudyPoint>& points, const std::vector<std::optional<StudyRecord>>& records,
                  std::size_t number, RunLog& log);

}  // namespace mortise
