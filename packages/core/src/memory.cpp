#include "mortise/core/memory.hpp"

#include <mpi.h>
#include <sys/resource.h>
#include <unistd.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace mortise {
namespace {

constexpr double mib = 1024.0 * 1024.0, kib = 1024.0;

/// The number of a file that holds nothing else; `otherwise` if it does not ("max").
double number_in(const std::string& path, double otherwise) {
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : otherwise;
}

/// The number in KiB behind a name in a file of the system, such as "MemAvailable:"; `otherwise` if it is not there.
double kib_behind(const std::string& path, const std::string& name, double otherwise) {
  std::ifstream file(path);
  for (std::string word; file >> word;)
    if (double number = 0.0; word == name && file >> number) return number;
  return otherwise;
}

/// Bytes that a limit of this process leaves.
double left_of(__rlimit_resource_t resource, double used) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::numeric_limits<double>::infinity();
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

}  // namespace

double peak_memory_mib() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / 1024.0 : 0.0;  // Linux counts in KiB
}

double machine_memory_mib() {
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) / mib;
  if (!(machine > 0.0)) return 0.0;
  return std::min(machine, number_in("/sys/fs/cgroup/memory.max", machine * mib) / mib);
}

double own_memory_left_mib() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double size = kib * kib_behind("/proc/self/status", "VmSize:", 0.0), data = kib * kib_behind("/proc/self/status", "VmData:", 0.0);
  const double left = std::min(left_of(RLIMIT_AS, size), left_of(RLIMIT_DATA, data));
  return left < infinity ? left / mib : infinity;
}

double machine_memory_left_mib() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double machine = kib * kib_behind("/proc/meminfo", "MemAvailable:", infinity);
  const double group = number_in("/sys/fs/cgroup/memory.max", infinity) - number_in("/sys/fs/cgroup/memory.current", 0.0);
  return std::max(0.0, std::min(machine, group)) / mib;
}

int ranks_on_this_machine(const Communicator& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  if (mpi == nullptr) return 1;
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(*mpi->getRawMpiComm(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  int ranks = 1;
  MPI_Comm_size(here, &ranks);
  MPI_Comm_free(&here);
  return ranks;
}

}  // namespace mortise
