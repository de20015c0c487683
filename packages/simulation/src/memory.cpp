#include "memory.hpp"

#include <sys/resource.h>

namespace mortise {

double peak_memory_mib() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<double>(usage.ru_maxrss) / 1024.0 : 0.0;  // Linux counts in KiB
}

}  // namespace mortise
