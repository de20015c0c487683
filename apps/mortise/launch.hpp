#pragma once
// How this process was started, and what that means for MPI.

#include <vector>

namespace mortise {

/// Whether mpirun, or what a cluster has in its place, started this process.
bool started_by_mpirun();

/// Whether this is the process that speaks for all, told without MPI.
bool is_first_process();

/// While it exists, Open MPI starts faster and without a daemon, if nobody started this process with other ranks. What the user has set stays.
/// Programs that this one starts do not inherit it: mpirun would refuse to give them other ranks.
class AloneInMpi {
 public:
  AloneInMpi();
  ~AloneInMpi();
  AloneInMpi(const AloneInMpi&) = delete;
  AloneInMpi& operator=(const AloneInMpi&) = delete;

 private:
  std::vector<const char*> set_;
};

}  // namespace mortise
