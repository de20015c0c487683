#include "launch.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

namespace mortise {

bool started_by_mpirun() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

bool is_first_process() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char* rank = std::getenv(name)) return std::strcmp(rank, "0") == 0;
  return true;
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
