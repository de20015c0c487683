#include <sched.h>

#include "program.hpp"

namespace mortise {

int cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace mortise
