#pragma once
// Equilibria that a step may not end at: unstable ones, and those that other forces lie before.

#include <functional>
#include <optional>
#include <string>

#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Checks that a solution is the neighbour of the last state. Its motion, over what drove it (Drive::strength()), is compared with the step
/// before. Up to a maximum of the load u goes like a root, so that equal changes of the load move by at most 1/(sqrt 2 - 1) = 2.4 times as much as
/// those before. A state that moved more than 2.5 times as much is refused for one of two reasons.
///
/// * det J < 0, and it was positive before, in a scene without contact: conditions of closed nodes have signs of their own. MUMPS tells the sign
///   with each factorisation. At a stable equilibrium it is positive. Along a path it changes where the path loses stability: at a maximum of the
///   load, or where another path branches off. A state that moved no farther is on such a path. It stands, and is reported.
/// * Forces between the two states are beyond both. Let g(s) = du . f_int(u + s du), 0 <= s <= 1, at eighths. If g is monotone, all its values are
///   between g(0) and g(1). If one is not there is a maximum in between: the structure snaps through.
///
/// A refused state is sought from the last one: without a predictor, then with smaller steps. If half the step goes half as far, the path became
/// softer within the step, and the state stands. An even number of negative eigenvalues is not seen, and with solvers that do not tell the sign,
/// none. Collective in all members.
class StabilityCheck final : public StepGuard {
 public:
  /// @param resolution  of displacements: what Newton's method leaves
  StabilityCheck(double resolution, std::function<void(const std::string&)> warn) : resolution_(resolution), warn_(std::move(warn)) {}

  /// @throws StepFailure(unstable), on every rank, for a solution that is no neighbour of `from`
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& to, int round) override;
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  void serialize(StateArchive& archive) override;

 private:
  double resolution_;
  std::function<void(const std::string&)> warn_;
  bool is_unstable_ = false;                         ///< the last accepted state
  std::optional<double> last_moved_, last_dt_;       ///< largest change of a displacement in the last step, and its length
  std::optional<double> refused_rate_, refused_dt_;  ///< of the step's last try that was refused
  bool passed_unstable_ = false;                     ///< the state that verify() passed last
  double passed_moved_ = 0.0, passed_dt_ = 0.0;
};

}  // namespace mortise
