#pragma once
// The command that goes on with a run.

#include <string>

#include "mortise/simulation/run/run.hpp"

namespace mortise {

/// The command line that goes on with a run that was stopped.
/// @param directory  of its results
std::string command_to_continue(const RunOptions& options, const std::string& directory, int ranks);

}  // namespace mortise
