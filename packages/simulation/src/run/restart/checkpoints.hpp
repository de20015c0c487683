#pragma once
// The checkpoints of a run: when one is due, and which of them stay.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/state_archive.hpp"
#include "mortise/io/output_directory.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Files checkpoints/step-000012.h5 in the directory of a run. Collective in all members.
class Checkpoints {
 public:
  /// @param run  where its directory is made when it writes first
  Checkpoints(RCP<const Communicator> comm, const CheckpointOptions& options, OutputDirectory run);

  /// True if the scene wants one after a step, whatever the clock.
  bool is_due_by_step(int step) const { return options_.every_step > 0 && step % options_.every_step == 0; }
  /// True if the scene wants one after a step, or the clock says so.
  bool is_due(int step) const;
  /// Writes what `store` stores as that after a step, then removes the oldest beyond those that are to be kept. Returns its size in bytes.
  /// @throws FileError on all ranks; earlier checkpoints stay
  std::uintmax_t write(int step, const std::function<void(StateArchive&)>& store);
  /// The last step of which this run has written one; 0: none.
  int last() const { return last_; }
  /// Seconds that the last one took.
  double seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  RCP<const Communicator> comm_;
  CheckpointOptions options_;
  OutputDirectory run_;
  int last_ = 0;
  double seconds_ = 0.0;
  Clock::time_point since_ = Clock::now();
};

/// Where the checkpoints of the run in a directory are.
std::string checkpoint_directory(const std::string& run_directory);

/// The checkpoint to go on from: that of `step`, or without one the newest that is whole.
struct FoundCheckpoint {
  int step = 0;
  std::string path;
  std::vector<std::string> damaged;  ///< newer ones that are not whole, and why
};

/// Collective.
/// @throws FileError on all ranks: there is none, or that of `step` is missing or damaged
FoundCheckpoint find_checkpoint(const Communicator& comm, const std::string& run_directory, std::optional<int> step);

/// Removes checkpoints of later steps, of a run that is continued from `step`, and what was not finished. Collective. Throws FileError on all ranks.
void remove_checkpoints_after(const Communicator& comm, const std::string& run_directory, int step);

}  // namespace mortise
