#pragma once
// How this process was started, and what that means for MPI.

namespace mortise {

/// Whether mpirun, or what a cluster has in its place, started this process.
bool started_by_mpirun();

/// Whether this is the process that speaks for all, told without MPI.
bool is_first_process();

/// Before MPI is started in a process that nobody started with other ranks: Open MPI starts faster, and without a daemon. What the user has set
/// stays. Programs that this process starts inherit it and have one rank each: commands that start runs use no MPI themselves.
void start_mpi_alone();

}  // namespace mortise
