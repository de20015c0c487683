#pragma once
// Memory of this process.

namespace mortise {

/// Largest resident size so far in MiB; 0 where the system does not say.
double peak_memory_mib();

}  // namespace mortise
