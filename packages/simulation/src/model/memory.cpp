#include "model/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace mortise {

double peak_memory_mib() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / 1024.0 : 0.0;  // Linux counts in KiB
}

double machine_memory_mib() {
  constexpr double mib = 1024.0 * 1024.0;
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) / mib;
  if (!(machine > 0.0)) return 0.0;
  double limit = 0.0;  // bytes; not a number where there is none ("max")
  std::ifstream group("/sys/fs/cgroup/memory.max");
  return group >> limit ? std::min(machine, limit / mib) : machine;
}

}  // namespace mortise
