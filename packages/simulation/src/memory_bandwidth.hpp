#pragma once
// How fast this machine's memory is.

namespace mortise {

/// Bytes per second that so many processes together read and write while each of them runs the triad a = b + s c over vectors of its own, larger than
/// the caches: the best of some repeats, counted as STREAM does (24 bytes for each entry). 0 if a process could not be started. This process must not
/// have started MPI or threads.
double triad_bandwidth(int processes);

}  // namespace mortise
