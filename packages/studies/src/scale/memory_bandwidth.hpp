#pragma once
// Bandwidth of this machine's memory.

namespace mortise {

/// Bytes per second that so many processes together read and write. Each of them runs the triad a = b + s c over vectors of its own that are larger
/// than the caches. The best of some repeats counts, as STREAM counts it (24 bytes for each entry). 0 if a process could not be started. This process
/// must not have started MPI or threads.
double triad_bandwidth(int processes);

}  // namespace mortise
