#include "launch.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>

namespace mortise {

namespace {

/// What a launcher tells the processes that it starts.
struct LauncherVariables {
  const char *launcher, *processes, *rank, *advice;
};

// The innermost launcher first: mpirun may have been started by srun. Slurm sets SLURM_PROCID in job scripts too, but SLURM_STEP_NUM_TASKS by srun
// alone. PALS says how many processes the node has; those of other nodes know by their rank that they are not alone.
constexpr std::array<LauncherVariables, 5> launchers{{
    {"mpirun", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "that of the Open MPI which this program was built with"},
    {"mpiexec", "PMI_SIZE", "PMI_RANK", "the mpirun of the MPI which this program was built with"},
    {"srun", "SLURM_STEP_NUM_TASKS", "SLURM_PROCID", "srun --mpi=pmix (srun --mpi=list says what there is), or mpirun within the job"},
    {"flux run", "FLUX_JOB_SIZE", "FLUX_TASK_RANK", "flux run -o pmi=pmix, or mpirun within the job"},
    {"mpiexec", "PALS_LOCAL_SIZE", "PALS_RANKID", "mpiexec --pmi=pmix, or the mpirun of the MPI which this program was built with"},
}};

/// A number in the environment.
std::optional<int> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  int number = 0;
  if (text == nullptr || std::from_chars(text, text + std::strlen(text), number).ec != std::errc()) return std::nullopt;
  return number;
}

bool has_mpi_of_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

}  // namespace

std::optional<StartedTogether> started_together() {
  for (const LauncherVariables& one : launchers) {
    const std::optional<int> processes = number_in(one.processes);
    if (!processes) continue;
    const int least = std::max(*processes, number_in(one.rank).value_or(0) + 1);
    if (least > 1) return StartedTogether{one.launcher, one.processes, least, one.advice};
    if (std::strcmp(one.launcher, "mpirun") == 0) return std::nullopt;  // one process by mpirun, whatever started mpirun
  }
  return std::nullopt;
}

bool started_by_mpirun() { return has_mpi_of_launcher() || started_together(); }

bool mpi_may_join() {
#ifdef OPEN_MPI
  return has_mpi_of_launcher();
#else
  return true;
#endif
}

std::string not_joined(const StartedTogether& together) {
  return fmt::format(
      "{0} started {1} processes or more ({2}), but MPI does not join them: each would be a run of its own, and all would write the same files.\n"
      "Please start them by {3}.\nFor a process that is meant to be alone: env -u {2} mortise ...",
      together.launcher, together.processes, together.variable, together.advice);
}

namespace {

bool has_first_rank() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* rank = std::getenv(name)) return std::strcmp(rank, "0") == 0;
  const std::optional<StartedTogether> together = started_together();
  if (!together) return true;
  const auto* one = std::find_if(launchers.begin(), launchers.end(), [&](const LauncherVariables& v) { return together->variable == v.processes; });
  return number_in(one->rank).value_or(0) == 0;
}

}  // namespace

// Open MPI gives a process that starts alone the rank 0, in its environment.
bool is_first_process() {
  static const bool first = has_first_rank();
  return first;
}

namespace {

/// The kernels that suit this processor where OpenBLAS took its slowest, else null.
const char* better_kernels() {
#ifdef __x86_64__
  const auto name = reinterpret_cast<char* (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  if (name == nullptr || std::strcmp(name(), "Prescott") != 0) return nullptr;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return nullptr;
  return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") ? "SkylakeX" : "Haswell";
#else
  return nullptr;
#endif
}

bool is_set(const char* variable) { return std::getenv(variable) != nullptr; }

}  // namespace

// OpenBLAS reads its variables as it is loaded, so they have to be there before.
void set_up_blas(char** argv) {
  if (dlsym(RTLD_DEFAULT, "openblas_get_corename") == nullptr) return;
  bool starts_anew = false;
  const auto set = [&](const char* variable, const char* value) {
    setenv(variable, value, 0);
    starts_anew = true;
  };
  if (!is_set("OPENBLAS_NUM_THREADS") && !is_set("OMP_NUM_THREADS")) set("OPENBLAS_NUM_THREADS", "1");
  if (const char* kernels = better_kernels(); kernels != nullptr && !is_set("OPENBLAS_CORETYPE")) set("OPENBLAS_CORETYPE", kernels);
  if (starts_anew) execv("/proc/self/exe", argv);  // if it fails, this process goes on
}

// By default a process alone starts the daemon orted, so that it could start others. If the process is killed, the daemon stays, and it grows. It
// also opens every network of the machine. A process that talks to none but itself needs neither. Without the daemon all such processes would share
// one directory for temporary files, which the first to end removes. So none makes it; shared file pointers, which are not used, do without it.
constexpr std::array<std::array<const char*, 2>, 5> settings{{{"OMPI_MCA_ess_singleton_isolated", "1"},
                                                              {"OMPI_MCA_btl", "self"},
                                                              {"OMPI_MCA_pml", "ob1"},
                                                              {"OMPI_MCA_orte_create_session_dirs", "0"},
                                                              {"OMPI_MCA_sharedfp", "individual"}}};

void start_mpi_alone() {
  for (const auto& [name, value] : settings) setenv(name, value, 0);
  // MUMPS asks for messages all the time, and none come. To yield each time, which many ranks on few cores need, makes it ten times slower beside
  // others.
  setenv("OMPI_MCA_mpi_yield_when_idle", "0", 1);
}

}  // namespace mortise
