#pragma once
// One Newton solve by NOX on a SemiSmoothSystem.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/log.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"

namespace mortise {

/// Use of a Newton direction.
enum class LineSearch {
  none,      ///< the full step
  backtrack  ///< the full step where it makes ResidualNorms::merit fall, else halved until it does
};

/// Order in which several fields are solved for.
enum class FieldSolution {
  monolithic,  ///< all at once
  staggered    ///< one after the other, with the others as they are, in turn until all are in balance
};

/// When a Newton solve is done, and when it is given up.
struct NewtonOptions {
  int maximum_iterations = 30;                       ///< beyond them it goes on only while states of contact change and the residual falls
  double momentum_tolerance = 1e-9;                  ///< |r| / max(|f_int|, |f_ext|, |f_c|)
  double gap_tolerance = 1e-9;                       ///< |g_j| / (A_j h) of closed nodes
  double complementarity_tolerance = 1e-9;           ///< |C| / max |z|
  double increment_tolerance = 1e-8;                 ///< |du|_max / size of the model
  double divergence = 1e8;                           ///< growth of |r| over max(|r_0|, |r_1|, s |du_1|) at which the solve is given up
  int cycle_length = 6;                              ///< longest cycle of active sets that is looked for
  LineSearch line_search = LineSearch::backtrack;    ///< use of directions
  std::optional<double> largest_increment;           ///< [length] of any displacement in one iteration; longer corrections are shortened
  FieldSolution fields = FieldSolution::monolithic;  ///< of several fields, as displacement and temperature
  int most_turns = 50;                               ///< turns of a step that is staggered
  void describe(Parameters& parameters);             ///< the list "newton"
};

/// One line of a table of Newton iterations.
struct NewtonIteration {
  int iteration = 0;          ///< 0: the start
  ResidualNorms norms;        ///< after it
  double increment = 0.0;     ///< max |du|; 0 in iteration 0
  double step_length = 1.0;   ///< share of the Newton direction that was taken
  int linear_iterations = 0;  ///< of the iterative solver
  double seconds = 0.0;       ///< wall-clock time
};

/// Report on Newton's method in a step.
struct NewtonReport {
  std::vector<NewtonIteration> iterations;  ///< of all solves of a step; iteration 0 begins one
  int solves = 1;                           ///< 1 + augmentations
  /// Directions taken, over all solves.
  int newton_steps() const { return static_cast<int>(iterations.size()) - solves; }
};

/// The iterate at which Newton's method was linearised last, and what it is evaluated with.
struct LinearisedIterate {
  RCP<const Vector> x;  ///< (d, z)
  StepContext context;  ///< of the step
};

/// Solves F(x) = 0 from an evaluation. Calls `observer` after each iteration. Returns the solution; throws StepFailure (on every rank) naming why
/// there is none. `report` holds what was done in either case, and so does `linearised`, unless it is null.
SystemEvaluation solve_newton(const SemiSmoothSystem& system, SystemEvaluation start, const NewtonOptions& options, NewtonReport& report,
                              const std::function<void(const NewtonIteration&)>& observer, std::optional<LinearisedIterate>* linearised = nullptr);

}  // namespace mortise
