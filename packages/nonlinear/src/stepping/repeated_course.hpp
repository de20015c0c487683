#pragma once
// Tries of a load step that fail in the same way whatever the size of the step.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/nonlinear/newton_solver.hpp"

namespace mortise::detail {

/// Watches the failed tries of one load step. With small strains and from a state without load, as at first contact of bodies that touch, the system
/// is homogeneous of degree one in the load. Half the step then goes through the same states of contact, and fails where the whole one did.
class RepeatedCourse {
 public:
  /// Tries of the same course after which a smaller step is of no use.
  static constexpr int enough = 3;

  /// Takes the next failed try. Failures of an evaluation have reasons that depend on the size of a step: they never count.
  /// @returns true if it and the `enough` - 1 before it ended Newton's method for the same reason after the same sequence of states of contact. The
  /// states have to change, or all tries have the same words with the same figures, decimals among them.
  bool add(const StepFailure& failure, const NewtonReport& report);

 private:
  std::vector<std::array<long long, 2>> course_;
  std::optional<FailureKind> kind_;
  std::string words_;
  int tries_ = 0, alike_ = 0;
};

}  // namespace mortise::detail
