#pragma once
// The end of a run as its exit code and in the log.

#include <optional>
#include <string>

#include "mortise/core/error.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "run/output/run_record.hpp"

namespace mortise {

/// Whether a run failed by an expression of its scene.
bool is_input(const std::optional<StepFailure>& failure);

/// Of a run whose checks have been evaluated.
/// @param is_written  whether all files of the end could be written
ExitCode exit_code(const RunRecord& record, const std::optional<StepFailure>& failure, bool is_written);

/// Quantities, checks, work of contact, why the run ended, and what it took.
/// @param directory  of its results
void report_end(const RunRecord& record, const std::optional<StepFailure>& failure, const std::string& directory, RunLog& log);

}  // namespace mortise
