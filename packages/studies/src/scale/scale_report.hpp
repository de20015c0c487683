#pragma once
// Tables and page of a series of runs.

#include <vector>

#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "scale/scale_record.hpp"

namespace mortise {

/// Writes scale.csv, scale.json, the plots and report.html of the points, whether they have been run or not. Returns done if all have finished, else
/// not_converged. Throws FileError.
ExitCode report_scale(const RCP<const Communicator>& comm, const ScaleOptions& options, const std::vector<ScalePoint>& points,
                      OutputDirectory& directory, RunLog& log);

}  // namespace mortise
