#pragma once
// study.csv and study.json.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mortise/studies/study.hpp"
#include "study/study_conclusions.hpp"

namespace mortise {

/// One row for each point: formulation, element, h, dofs, steps, newton_iterations, wall_s, cpu_s, memory_mib, an error_<name> for each quantity,
/// status, an axis_<name> for each axis. A missing number leaves its cell empty. Throws FileError.
void write_study_table(const RCP<const Communicator>& comm, const std::string& path, const StudyPlan& plan, const StudyResults& results,
                       const std::vector<StudyErrors>& errors);

/// All that the page is drawn from; docs/study.md lists its names.
nlohmann::ordered_json study_json(const StudyOptions& options, const StudyPlan& plan, const StudyResults& results,
                                  const std::vector<StudyCurve>& curves, const std::vector<StudyErrors>& errors,
                                  const std::vector<StudyConclusions>& conclusions);

}  // namespace mortise
