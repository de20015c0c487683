#include "mortise/simulation/run/output/newton_table.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {

std::string step_header(int step, double time, double end_time, double dt) {
  return fmt::format("step {}  t={:.6g} of {:.6g}  dt={:.6g}", step, time, end_time, dt);
}

std::string newton_header() { return " it     |r|/|f|    |gap|     |du|    active   stick/slip  changed   lin      s"; }

std::string newton_line(const NewtonIteration& iteration) {
  const auto& norms = iteration.norms;
  const std::string increment = iteration.iteration == 0 ? "-" : fmt::format("{:.1e}", iteration.increment);
  const std::string linear = iteration.linear_iterations == 0 ? "-" : fmt::format("{}", iteration.linear_iterations);
  return fmt::format("{:3d}   {:.2e}   {:.1e}  {:>8}   {:6d}  {:>11}   {:6d}  {:>4}  {:5.2f}", iteration.iteration, norms.momentum, norms.gap,
                     increment, norms.active, fmt::format("{}/{}", norms.sticking, norms.active - norms.sticking), norms.changed, linear,
                     iteration.seconds);
}

std::string step_footer(const StepReport& report, double seconds_left) {
  double seconds = 0.0;
  for (const auto& iteration : report.newton.iterations) seconds += iteration.seconds;
  return fmt::format("  done in {} iterations, {:.2f} s{}", report.newton.newton_steps(), seconds,
                     seconds_left < 1.0 ? "" : "; about " + duration(seconds_left) + " left");
}

std::string duration(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  const long minutes = std::lround(seconds / 60.0);
  return minutes < 100 ? fmt::format("{} min", minutes) : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace mortise
