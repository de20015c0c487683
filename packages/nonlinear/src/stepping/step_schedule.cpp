#include "mortise/nonlinear/step_schedule.hpp"

#include <algorithm>

namespace mortise {
namespace {

constexpr double round_off = 1e-9;  // of a step: what is nearer to a target than this is the target

}  // namespace

StepSchedule::StepSchedule(const SteppingOptions& options, double time, std::optional<double> next_step)
    : time_(time), maximum_(options.maximum_step.value_or(options.step)), minimum_(options.minimum_step.value_or(options.step / 1024.0)) {
  step_ = std::min(next_step.value_or(options.step), maximum_);
  for (const double time : options.output_times)
    if (time > 0.0 && time < options.end_time) targets_.push_back(time);
  targets_.push_back(options.end_time);
  std::sort(targets_.begin(), targets_.end());
}

double StepSchedule::next_time() const {
  const double target = *std::find_if(targets_.begin(), targets_.end() - 1, [this](double t) { return t > time_; });
  return time_ + step_ * (1.0 + round_off) < target ? time_ + step_ : target;
}

// A step that a target cut short says nothing about the next one's size.
void StepSchedule::accept(double growth) {
  const double next = next_time(), length = next - time_;
  const bool whole = length >= step_ * (1.0 - round_off);
  time_ = next;
  if (growth > 1.0 && whole) step_ = std::min(growth * step_, maximum_);
  if (growth < 1.0) step_ = std::clamp(growth * length, std::min(minimum_, step_), step_);
}

bool StepSchedule::cut() {
  const double half = 0.5 * (next_time() - time_);
  if (half < minimum_ * (1.0 - round_off)) return false;
  step_ = half;
  return true;
}

}  // namespace mortise
