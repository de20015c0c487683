#pragma once
// Seconds by timer name, from nested timers.

#include <map>
#include <string>

#include "mortise/core/timers.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Collective. For each timer name (underscores for spaces) the seconds, mean over the ranks, summed over all places it stands at in the tree. The
/// outermost timer must have been stopped.
std::map<std::string, double> seconds_by_name(const Timers& timers, const RCP<const Communicator>& comm);

/// Collective. The whole tree as text, on rank 0.
std::string timer_report(const Timers& timers, const RCP<const Communicator>& comm);

}  // namespace mortise
