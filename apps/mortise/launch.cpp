#include "launch.hpp"

#include <cstdlib>
#include <cstring>
#include <utility>

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

// By default a process alone starts the daemon orted, so that it could start others. If the process is killed, the daemon stays, and it grows. It
// also opens every network of the machine. A process that talks to none but itself needs neither.
AloneInMpi::AloneInMpi() {
  if (started_by_mpirun()) return;
  using Setting = std::pair<const char*, const char*>;
  for (const auto& [name, value] :
       {Setting{"OMPI_MCA_ess_singleton_isolated", "1"}, Setting{"OMPI_MCA_btl", "self"}, Setting{"OMPI_MCA_pml", "ob1"}}) {
    if (std::getenv(name) != nullptr) continue;
    setenv(name, value, 1);
    set_.push_back(name);
  }
}

AloneInMpi::~AloneInMpi() {
  for (const char* name : set_) unsetenv(name);
}

}  // namespace mortise
