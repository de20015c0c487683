#pragma once
// Memory of this process and of its machine.

#include "mortise/core/types.hpp"

namespace mortise {

/// Largest resident size so far in MiB; 0 where the system does not say.
double peak_memory_mib();

/// Memory of this machine in MiB, or what a control group leaves this process of it; 0 where the system does not say.
double machine_memory_mib();

/// Memory that the limits of this process (`ulimit -v`, `ulimit -d`) let it take beyond what it has, in MiB; infinite without limits.
double own_memory_left_mib();

/// Memory that all processes of this machine, or of this control group, can still take without swapping, in MiB; infinite where it is not known.
double machine_memory_left_mib();

/// Ranks of a communicator on the machine of this rank. Collective.
int ranks_on_this_machine(const Communicator& comm);

}  // namespace mortise
