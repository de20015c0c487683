#pragma once
// One material point on its path, from its file to its results.

#include "mortise/simulation/run/run.hpp"

namespace mortise {

/// Collective. Drives one material point as a point file (options.scene) says. Leaves in the directory: point.csv, summary.json, effective.xml and,
/// if python3 with matplotlib is here, point.svg and point.png. A file that cannot be run leaves the directory as it was.
/// Returns done or not_converged, with what came before in the files. Throws InputError and FileError on all ranks.
ExitCode run_point(const RCP<const Communicator>& comm, const RunOptions& options);

}  // namespace mortise
