#pragma once
// The Newton iterations as people read them: the table of the log.

#include <string>

#include "mortise/nonlinear/load_stepper.hpp"

namespace mortise {

/// "step 12/40  t=0.300  dt=0.025". `steps` is an estimate from the step size; 0: not shown.
std::string step_header(int step, int steps, double time, double dt);

/// Names of the table's columns.
std::string newton_header();

/// One line per iteration; |r|/|f| is ResidualNorms::momentum, the number that has a tolerance.
std::string newton_line(const NewtonIteration& iteration);

/// What a finished step says: iterations and time.
std::string step_footer(const StepReport& report);

}  // namespace mortise
