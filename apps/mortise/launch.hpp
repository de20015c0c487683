#pragma once
// How this process was started, and what that means for MPI.

namespace mortise {

/// Whether mpirun, or what a cluster has in its place, started this process.
bool started_by_mpirun();

/// Whether this is the process that speaks for all, told without MPI.
bool is_first_process();

/// Starts the program anew, once, where OpenBLAS does not know the processor and takes its slowest kernels although the processor has AVX2: Debian's
/// 0.3.21 does so on each processor that is newer. OPENBLAS_CORETYPE in the environment stays as it is.
void choose_blas_kernels(char** argv);

/// Before MPI is started in a process that nobody started with other ranks: Open MPI starts faster, and without a daemon. What the user has set
/// stays. Programs that this process starts inherit it and have one rank each: commands that start runs use no MPI themselves.
void start_mpi_alone();

}  // namespace mortise
