#pragma once
// Parts of a run that look at its steps: one interface, whatever they look for.

#include <memory>
#include <optional>
#include <vector>

#include "mortise/core/state_archive.hpp"
#include "mortise/nonlinear/load_stepper.hpp"

namespace mortise {

/// The end of a run's steps.
struct EndOfSteps {
  bool is_converged;             ///< the end time is reached
  const SystemEvaluation* last;  ///< of the last accepted state, in the step that led there; null: another step has been tried since
};

/// Judges the steps of a run and remembers what it needs for that. Hooks are called on every rank, and their defaults do nothing.
class StepGuard {
 public:
  StepGuard() = default;
  StepGuard(const StepGuard&) = delete;
  StepGuard& operator=(const StepGuard&) = delete;
  virtual ~StepGuard() = default;

  /// A try of a step begins.
  virtual void begin() {}
  /// Multipliers to start Newton's method with that are better than those of `start`; null: these are as good.
  virtual RCP<Vector> close(const SemiSmoothSystem&, const SystemEvaluation& /*start*/) { return Teuchos::null; }
  /// A converged state of a step from the accepted state `from`. `round` counts the solutions of a try from 1.
  /// @returns null if it stands, else another start from which the step is solved once more
  /// @throws StepFailure, on every rank: the try is undone
  virtual RCP<Vector> verify(const SemiSmoothSystem&, const AcceptedState& /*from*/, const SystemEvaluation& /*found*/, int /*round*/) {
    return Teuchos::null;
  }
  /// Cause of a failure of Newton's method, in words for people; "": not known.
  virtual FailureExplanation explain(const SemiSmoothSystem&, const FailedTry&) { return {}; }
  /// May change the rate of the step of length dt that was accepted in x, along which the next step is predicted.
  virtual void predict(const SemiSmoothSystem&, const Vector& /*x*/, double /*dt*/, Vector& /*rate*/) {}
  /// Length of the next step over that of the step that was verified last; nothing: another rule says.
  virtual std::optional<double> growth() const { return std::nullopt; }
  /// The state that was verified last is accepted.
  virtual void accept(const SemiSmoothSystem&, const SystemEvaluation&) {}
  /// The steps are over. A failure: the run may not end at its last state.
  virtual std::optional<StepFailure> end(const SemiSmoothSystem&, const EndOfSteps&) { return std::nullopt; }
  /// Stores or restores what it knows of accepted states and has said.
  virtual void serialize(StateArchive&) {}
};

/// They are asked in their order. The first that has another start, or other multipliers, is the last one asked.
using StepGuards = std::vector<std::shared_ptr<StepGuard>>;

/// Asks the guards before what the observer does already. They have to live as long as the observer is called.
void guard_steps(StepperObserver& observer, const StepGuards& guards, const SemiSmoothSystem& system);

/// Asks the guards at the end of the steps. The first failure counts: to those behind it the run has not converged. Collective.
std::optional<StepFailure> end_steps(const StepGuards& guards, const SemiSmoothSystem& system, EndOfSteps end);

}  // namespace mortise
