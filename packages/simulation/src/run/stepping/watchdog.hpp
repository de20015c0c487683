#pragma once
// Tells of ranks that give no sign of life: stopped, or swapped out.

#include <memory>

#include "mortise/core/types.hpp"

namespace mortise {

/// While it lives, a thread of each rank gives a sign each second, in memory that the ranks of a machine share. The lowest rank that is awake says on
/// standard error which others of its machine have given none for a while, and when they are back. Others wait for them without a word. A machine
/// that is gone as a whole is seen by mpirun. Nothing is made for a single rank. Collective in constructor and destructor.
class Watchdog {
 public:
  explicit Watchdog(const Communicator& comm);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mortise
