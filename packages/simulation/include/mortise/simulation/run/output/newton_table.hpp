#pragma once
// The Newton iterations as people read them: the table of the log.

#include <string>

#include "mortise/nonlinear/load_stepper.hpp"

namespace mortise {

/// "step 12  t=0.3 of 1  dt=0.025".
std::string step_header(int step, double time, double end_time, double dt);

/// Names of the table's columns.
std::string newton_header();

/// One line per iteration; |r|/|f| is ResidualNorms::momentum, the number that has a tolerance.
std::string newton_line(const NewtonIteration& iteration);

/// Line of a finished step: iterations, time and, if it is a second or more, the time left.
std::string step_footer(const StepReport& report, double seconds_left);

/// "42 s", "7 min", "2 h 5 min".
std::string duration(double seconds);

}  // namespace mortise
