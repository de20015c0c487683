#pragma once
// The start of this process, and what it means for MPI.

#include <optional>
#include <string>

namespace mortise {

/// Several processes that a launcher started together, as its variables in the environment say.
struct StartedTogether {
  std::string launcher;  ///< "srun"
  std::string variable;  ///< that tells their number
  int processes = 1;     ///< 2 or more
  std::string advice;    ///< that lets MPI join them
};

/// None if this process was started alone, or by a launcher that says no number of processes.
std::optional<StartedTogether> started_together();

/// True if mpirun, or what a cluster has in its place, started this process.
bool started_by_mpirun();

/// True if MPI of this build can join processes that were started together. Open MPI finds the others by PMIx or PMI alone; of other libraries only
/// their start tells.
bool mpi_may_join();

/// The message where MPI has not joined them: each would be a run of its own.
std::string not_joined(const StartedTogether& together);

/// True if this is the process that prints for all, known without MPI.
bool is_first_process();

/// Starts the program anew, once, where OpenBLAS would not suit it. One thread a process, as ranks share the cores; further threads also never end
/// where memory is limited. The kernels of the processor's AVX2 or AVX-512 where OpenBLAS takes its slowest: Debian's 0.3.21 does so on each
/// processor that it does not know. OPENBLAS_NUM_THREADS, OMP_NUM_THREADS and OPENBLAS_CORETYPE in the environment stay as they are.
void set_up_blas(char** argv);

/// Before MPI is started in a process that nobody started with other ranks: Open MPI starts faster, and without a daemon. Settings of the user
/// stay. Programs that this process starts inherit them and have one rank each: commands that start runs use no MPI themselves.
void start_mpi_alone();

}  // namespace mortise
