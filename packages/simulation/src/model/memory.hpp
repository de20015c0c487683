#pragma once
// Memory of this process and of its machine.

namespace mortise {

/// Largest resident size so far in MiB; 0 where the system does not say.
double peak_memory_mib();

/// Memory of this machine in MiB, or what a control group leaves this process of it; 0 where the system does not say.
double machine_memory_mib();

}  // namespace mortise
