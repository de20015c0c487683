#pragma once
// Rates of a machine, from measured runs.

#include <vector>

#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/model/run_log.hpp"
#include "mortise/studies/machine_file.hpp"
#include "scale/scale_record.hpp"

namespace mortise {

/// Work and time of a phase in one run.
struct MeasuredWork {
  double most = 0.0, whole = 0.0;  ///< with counts and slowdown
  double seconds = 0.0;
};

/// The rates, neither below zero, whose times come nearest to those of the runs in the mean of squared relative differences.
PhaseRate fitted_rate(const std::vector<MeasuredWork>& runs);

/// Leaves `machine` as machine.xml with the rates and counts of the finished points. Plans of these are made in processes of their own. Says why it
/// leaves none where points were solved directly or no plan could be made.
void write_measured_machine(const RCP<const Communicator>& comm, const ScaleOptions& options, const std::vector<ScalePoint>& points,
                            MachineFile machine, OutputDirectory& directory, RunLog& log);

}  // namespace mortise
