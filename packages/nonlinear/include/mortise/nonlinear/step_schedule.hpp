#pragma once
// Choice of the next step of pseudo-time.

#include <vector>

#include "mortise/nonlinear/load_stepper.hpp"

namespace mortise {

/// Sizes of steps, without any solver: proposes a time, learns whether it worked. Output times and the end are hit exactly.
class StepSchedule {
 public:
  /// @param time       where it stands
  /// @param next_step  length of the next step; none: the first one of the options
  explicit StepSchedule(const SteppingOptions& options, double time = 0.0, std::optional<double> next_step = std::nullopt);

  double time() const { return time_; }                       ///< of the last accepted step
  double next_step() const { return step_; }                  ///< length of the next step unless a target cuts it short
  bool finished() const { return time_ >= targets_.back(); }  ///< true if the end was reached
  double next_time() const;                                   ///< where the next try ends
  /// The try worked; the next step is to be `growth` times as long as it.
  void accept(double growth);
  /// The try failed: the next one is half as long. False if that is shorter than the smallest step.
  bool cut();

 private:
  std::vector<double> targets_;  ///< output times and the end, ascending
  double time_, step_, maximum_, minimum_;
};

}  // namespace mortise
