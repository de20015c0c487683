#pragma once
// Signals and the time limit: what asks a run to leave a checkpoint, or to end.

#include <chrono>
#include <optional>
#include <string>

#include "mortise/core/types.hpp"

namespace mortise {

/// Requests since the last look, the same on every rank.
struct Request {
  bool checkpoint = false;          ///< leave one and go on
  std::optional<std::string> stop;  ///< leave one and end: the name of the signal, or "time limit"
};

/// While it lives, signals are requests:
/// * SIGTERM, SIGINT, SIGHUP, SIGUSR1: stop after this Newton iteration; a second SIGINT ends the program at once;
/// * SIGUSR2: checkpoint after this step.
/// Signals that were ignored before stay so. Afterwards signals do what they did before.
class StopRequest {
 public:
  /// @param watch_signals  whether signals are looked at; one object at a time may do so
  /// @param time_limit     seconds since `begin` for all of the run; none: no limit
  StopRequest(bool watch_signals, std::optional<double> time_limit, std::chrono::steady_clock::time_point begin);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// After a step: what any rank was asked for. With a time limit a run stops where another step like the longest of the last ones, and its
  /// checkpoint, would not fit. Collective.
  Request after_step(const Communicator& comm);

  /// After a Newton iteration: a signal, which does not wait for the end of the step as a time limit does. Collective.
  std::optional<std::string> within_step(const Communicator& comm) const;

  /// Seconds that a checkpoint took, to be kept free before the time limit.
  void reserve(double seconds) { reserved_ = seconds; }

 private:
  using Clock = std::chrono::steady_clock;
  bool watches_;
  std::optional<double> limit_;
  double reserved_ = 0.0, longest_ = 0.0;
  Clock::time_point begin_, last_ = Clock::now();
};

}  // namespace mortise
