#pragma once
// Outcome of a run of the ledger.

#include <string>

#include "hard/hard_plan.hpp"
#include "shared/text_table.hpp"
#include "study/study_record.hpp"

namespace mortise {

/// A run that ended.
struct HardOutcome {
  StudyRecord record;
  TextTable history;   ///< a row for each accepted step
  int steps = 0;       ///< accepted
  int cutbacks = 0;    ///< tries that were undone
  int iterations = 0;  ///< of all tries, those that were undone included
  double time = 0.0;   ///< of the last accepted state

  /// Adds all figures to what expressions may name, with `prefix` before each name.
  void name_figures(const HardRun& run, const std::string& prefix, HardNames& names) const;
};

/// Runs it on so many ranks, unless an earlier call finished the same with the same program. `version`: of the program, its build included.
HardOutcome run_hard_line(const Communicator& comm, const HardRun& run, int ranks, const std::string& directory, const std::string& version,
                          const Launcher& launcher);

}  // namespace mortise
