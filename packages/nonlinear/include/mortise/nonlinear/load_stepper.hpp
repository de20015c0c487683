#pragma once
// Walks pseudo-time: steps, undo, halving, growth.

#include <functional>
#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/nonlinear/newton_solver.hpp"

namespace mortise {

/// Where the Newton iterations of a step start.
enum class Predictor {
  none,   ///< at the last accepted state
  linear  ///< on the line through the last two accepted states, as far as loads and prescribed motions go on: points that flow start flowing
};

/// Pseudo-time and its steps.
struct SteppingOptions {
  double end_time = 1.0;                    ///< pseudo-time at which the run ends; it begins at 0
  double step = 1.0;                        ///< first step, and the largest unless `maximum_step` says otherwise
  std::optional<double> maximum_step;       ///< default: `step`
  std::optional<double> minimum_step;       ///< default: step / 1024
  int easy_iterations = 6;                  ///< most iterations of a step that may be followed by one twice as long
  std::vector<double> output_times;         ///< hit exactly
  Predictor predictor = Predictor::linear;  ///< where steps start
  void describe(Parameters& parameters);    ///< the list "stepping"
};

/// A finished step.
struct StepReport {
  int step = 0;                     ///< from 1
  double time = 0.0;                ///< pseudo-time at its end
  double dt = 0.0;                  ///< its length
  int cutbacks = 0;                 ///< tries undone before this one
  std::vector<std::string> undone;  ///< why, one for each cutback
  NewtonReport newton;              ///< of the try that worked
};

/// Where a run stands between two steps: all that the next one starts from.
struct SteppingState {
  /// At the start of a run.
  explicit SteppingState(AcceptedState state) : accepted(std::move(state)) {}
  AcceptedState accepted;           ///< of the last step, or the first state
  int steps = 0;                    ///< finished ones
  std::optional<double> next_step;  ///< length of the next step unless a target cuts it short; none: the first one of the options
  RCP<const Vector> rate;           ///< of the last step, which a predictor follows; null: there is none
  double last_step = 0.0;           ///< length of the last step, where there is a rate
};

/// Stores where a run stands.
void store(StateArchive& archive, const SemiSmoothSystem& system, const SteppingState& state);
/// Where the run stood that was stored, by any number of ranks. Throws StepFailure on every rank.
SteppingState restore_stepping(StateArchive& archive, const SemiSmoothSystem& system);

/// A try of a step that failed.
struct FailedTry {
  const StepFailure& failure;                          ///< why
  const AcceptedState& from;                           ///< from where
  double time;                                         ///< to which
  const StepContext& context;                          ///< context of the step
  const std::optional<LinearisedIterate>& linearised;  ///< where Newton's method was linearised last; none: it was not
};

/// Explanation of a failure of Newton's method.
struct FailureExplanation {
  std::string words;         ///< they stand before the failure's message; "" without an explanation
  bool at_any_step = false;  ///< it says nothing of the size of the step: three tries in a row with it are the last
};

/// Functions that the stepper calls.
struct StepperObserver {
  std::function<void(int step, double time, double dt)> begin;  ///< before each try
  /// Multipliers for the start of a try that may be better than those of its StepStart; null: they are not.
  std::function<RCP<Vector>(const SystemEvaluation& start)> close;
  std::function<void(const NewtonIteration&)> iteration;  ///< after each Newton iteration
  std::function<bool()> interrupted;                      ///< after that. True, the same on every rank: the run ends here, at its last state
  /// A solution of the step from the accepted state `from`, before it is committed. `round` counts the solutions of a try from 1. Returns null if the
  /// solution stands, else another start, from which the step is solved once more. May throw StepFailure, on every rank: the try is undone.
  std::function<RCP<Vector>(const AcceptedState& from, const SystemEvaluation& solution, int round)> verify;
  /// May change the rate of the step of length dt that was accepted in x: the line that the next step starts at.
  std::function<void(const Vector& x, double dt, Vector& rate)> predict;
  /// Length of the next step over that of the step that was verified last, the same on every rank; nothing, or empty: twice as long after an easy
  /// step.
  std::function<std::optional<double>()> growth;
  std::function<void(const StepReport&, const SystemEvaluation&)> accepted;  ///< after commit
  /// Between two steps, the last of which has been accepted. True: the run ends here. The same on every rank.
  std::function<bool(const SteppingState& state)> rest;
  std::function<void(const StepReport&, const StepFailure&)> undone;  ///< a try failed
  std::function<FailureExplanation(const FailedTry&)> explain;        ///< of a failure of Newton's method
};

/// Makes what holds within a try of a step from a state to a time, which starts at displacement d, and guesses multipliers z (the contact start
/// rule).
using StepStart = std::function<StepContext(const AcceptedState& state, double time, const Vector& d, Vector& z)>;

/// Runs from the time of a state to the end. On return `state` is that after the last accepted step. Returns true at the end time; false when the
/// smallest step failed, with its failure in `last_failure`, and without one where the observer wanted rest or interrupted a step. Each try is
/// prepared by `start`; without one nothing is guessed.
///
/// With a predictor a step starts on the line through the last two states. It goes on there by the share of the last step's changes of loads and
/// prescribed displacements that is made again (Drive::continuation()), and at most by the length of the step. It starts at the last state where that
/// is nothing, where what drives it is not known and the last state is a solution of this step too, or where the residual of the predicted one is a
/// thousand times as large. A solution that is refused, and was predicted, is sought from the last state before the step is cut.
/// In a system with time derivatives it starts where velocities and accelerations lead to, and steps keep their length, or what the observer says.
bool run_steps(const SemiSmoothSystem& system, const SteppingOptions& stepping, const NewtonOptions& newton, SteppingState& state,
               const StepStart& start, const StepperObserver& observer, std::optional<StepFailure>& last_failure);

}  // namespace mortise
