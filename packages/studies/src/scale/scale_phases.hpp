#pragma once
// Phases of a run's time, and what their work is counted in.

#include <string>
#include <vector>

namespace mortise {

/// Phase of a run's time: timers of summary.json that belong together. The rest of the total is the last one, without timers.
struct ScalePhase {
  /// Count of a run that its work is multiplied with.
  enum class Times { once, newton_iterations, linear_iterations };

  std::string name;
  std::vector<std::string> timers;
  std::string unit;           ///< of its work, in words
  Times times = Times::once;  ///< how often that is done
  bool streams = false;       ///< matrices are streamed through memory, whose bandwidth the ranks of a node share
};
const std::vector<ScalePhase>& scale_phases();

}  // namespace mortise
