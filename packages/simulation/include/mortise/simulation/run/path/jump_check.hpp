#pragma once
// A step whose solution lies on another branch of equilibria: between the two there is motion with inertia.

#include <optional>

#include "mortise/nonlinear/semi_smooth_system.hpp"

namespace mortise {

/// Compares steps by their rates, the largest change of a displacement over the change of pseudo-time.
///
/// Along a path of equilibria a step of half the length has nearly the same rate. A jump is as far however short the step, so that its rate doubles.
/// A step is suspect if it goes 2.5 times as fast as the step before, and far: more than 5 % of the model, or a body farther than it can be carried.
/// It is tried with half the length, and stands if the rate then is at most 1.5 times as large. Of the first step nothing is known. Collective in all
/// members.
class JumpCheck {
 public:
  /// @param length  size of the model
  explicit JumpCheck(double length) : length_(length) {}

  /// Of a solution `to` of the step of length dt from the accepted state `from`, both displacements.
  /// @param is_far  whether a body goes farther than what is around it carries it: see StateCheck
  /// @throws StepFailure(lost_contact), on every rank, for one that may have jumped
  void verify(const Vector& from, const Vector& to, double dt, bool is_far = false);
  /// The state that verify() passed last is accepted.
  void accept();
  /// Stores or restores the rate of the last step.
  void serialize(StateArchive& archive);

 private:
  double length_;
  std::optional<double> accepted_;  ///< rate of the last step
  std::optional<double> refused_;   ///< rate of the step's last try that was refused
  double passed_ = 0.0;
};

}  // namespace mortise
