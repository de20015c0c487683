#include "newton/newton_status_tests.hpp"

#include <NOX_Abstract_Group.H>
#include <NOX_Solver_Generic.H>
#include <fmt/format.h>

#include <Teuchos_Time.hpp>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "newton/backtracking.hpp"
#include "newton/newton_progress.hpp"
#include "newton/semi_smooth_newton_group.hpp"

namespace mortise::detail {
namespace {
/// Of the increment's tolerance: a correction below it that changes states has no effect.
constexpr double no_effect = 1e-3;

// True if the rest of the residual is a jump of the integrals of contact, and no error that a correction takes away. A rule for them is exact on
// no warped facet. Where edges of the two sides lie over one another the parts that it acts on change at once, and the integral with them, by 1e-9 of
// itself and less. Newton's method then steps from one side to the other: the states stay, whole corrections are far below their tolerance, the
// residual no longer falls.
bool jumps(const IterateTest::Iterates& iterates, const NewtonOptions& options, double length) {
  constexpr std::size_t steps = 4;
  constexpr double largest = 100.0, falls = 0.5;  // of the tolerances; of the smallest before
  if (iterates.size() <= steps) return false;
  const auto first = iterates.end() - steps;
  const auto less = [](const NewtonIteration& a, const NewtonIteration& b) { return a.norms.merit < b.norms.merit; };
  if (std::min_element(first, iterates.end(), less)->norms.merit < falls * std::min_element(iterates.begin(), first, less)->norms.merit) return false;
  return std::all_of(first, iterates.end(), [&](const NewtonIteration& at) {
    const ResidualNorms& norms = at.norms;
    return norms.changed == 0 && norms.active > 0 && norms.momentum <= largest * options.momentum_tolerance &&
           norms.gap <= largest * options.gap_tolerance && norms.complementarity <= largest * options.complementarity_tolerance &&
           at.step_length > 0.0 && at.increment <= negligible_correction(options, length) * at.step_length;
  });
}
}  // namespace

NewtonHistory::NewtonHistory(NewtonReport& report) : report_(report), last_time_(Teuchos::Time::wallTime()) { report_.iterations.clear(); }

const std::vector<NewtonIteration>& NewtonHistory::update(const NOX::Solver::Generic& solver) {
  auto& iterations = report_.iterations;
  if (static_cast<int>(iterations.size()) > solver.getNumIterations()) return iterations;
  const auto& group = dynamic_cast<const SemiSmoothNewtonGroup&>(solver.getSolutionGroup());
  const double now = Teuchos::Time::wallTime();
  NewtonIteration iteration;
  iteration.iteration = solver.getNumIterations();
  iteration.norms = group.norms();
  iteration.increment = std::max(0.0, group.increment());
  iteration.step_length = group.step_length();
  iteration.linear_iterations = group.linear_solve().iterations;
  iteration.seconds = now - last_time_;
  last_time_ = now;
  iterations.push_back(iteration);
  return iterations;
}

NOX::StatusTest::StatusType IterateTest::checkStatus(const NOX::Solver::Generic& solver, NOX::StatusTest::CheckType type) {
  const auto& iterates = history_.update(solver);
  status_ = type == NOX::StatusTest::None ? NOX::StatusTest::Unevaluated : check(iterates);
  return status_;
}

std::ostream& IterateTest::print(std::ostream& stream, int indent) const {
  return stream << std::string(static_cast<std::size_t>(indent), ' ') << status_ << name_ << '\n';
}

std::vector<ConvergenceCriterion> convergence_criteria(const NewtonOptions& options, double length) {
  using Iterates = IterateTest::Iterates;
  std::vector<ConvergenceCriterion> criteria;
  const auto bounded = [&](const std::string& name, double ResidualNorms::*norm, double tolerance) {
    criteria.push_back({fmt::format("{} (tolerance {:.1e})", name, tolerance),
                        [=](const Iterates& iterates) { return iterates.back().norms.*norm <= tolerance || jumps(iterates, options, length); },
                        [=](const NewtonIteration& at) { return fmt::format("{:.2e}", at.norms.*norm); }});
  };
  const auto is_round_off = [](const ResidualNorms& norms) { return norms.momentum_absolute <= norms.round_off; };
  criteria.push_back({fmt::format("momentum (tolerance {:.1e})", options.momentum_tolerance),
                      [=](const Iterates& iterates) {
                        const ResidualNorms& norms = iterates.back().norms;
                        return norms.momentum <= options.momentum_tolerance || is_round_off(norms) || jumps(iterates, options, length);
                      },
                      [](const NewtonIteration& at) { return fmt::format("{:.2e}", at.norms.momentum); }});
  bounded("prescribed displacements", &ResidualNorms::prescribed, options.increment_tolerance);
  bounded("gap", &ResidualNorms::gap, options.gap_tolerance);
  bounded("complementarity", &ResidualNorms::complementarity, options.complementarity_tolerance);
  // The correction that led to an iterate says how wrong the one before was. If the residual is far below its tolerance the iterate itself is
  // known to be right, and computing a correction that only confirms it would be one iteration for nothing.
  criteria.push_back({fmt::format("increment (tolerance {:.1e})", options.increment_tolerance),
                      [=](const Iterates& iterates) {
                        const NewtonIteration& at = iterates.back();
                        const bool small = at.iteration > 0 && at.increment <= options.increment_tolerance * length;
                        return small || at.norms.momentum <= 1e-3 * options.momentum_tolerance || (at.iteration > 0 && is_round_off(at.norms));
                      },
                      [=](const NewtonIteration& at) { return fmt::format("{:.2e}", at.increment / length); }});
  // The starting point has no active set before it; its complementarity has been tested above.
  criteria.push_back({"changes of state (none allowed)",
                      [=, others = criteria](const Iterates& iterates) {
                        const NewtonIteration& last = iterates.back();
                        if (last.iteration == 0 || last.norms.changed == 0) return true;
                        if (last.step_length < 1.0 || last.increment > no_effect * options.increment_tolerance * length) return false;
                        const Iterates before(iterates.begin(), iterates.end() - 1);
                        return std::all_of(others.begin(), others.end(), [&](const auto& other) { return other.met(iterates) && other.met(before); });
                      },
                      [](const NewtonIteration& at) { return fmt::format("{} nodes, {} closed", at.norms.changed, at.norms.active); }});
  return criteria;
}

NOX::StatusTest::StatusType ConvergenceTest::check(const Iterates& iterates) {
  return criterion_.met(iterates) ? NOX::StatusTest::Converged : NOX::StatusTest::Unconverged;
}

std::optional<StepFailure> reason_to_give_up(const std::vector<NewtonIteration>& iterates, const NewtonOptions& options,
                                             const std::vector<ConvergenceCriterion>& criteria, double stiffness) {
  const NewtonIteration& last = iterates.back();
  if (!last.norms.finite || !std::isfinite(last.increment))
    return StepFailure(FailureKind::not_finite, fmt::format("residual or increment is not finite in Newton iteration {}", last.iteration));

  // Iterate 0 may be in equilibrium but for what has just been prescribed, and iterate 1 again if that moved a body as a whole up to contact. Their
  // |r| alone are no measure of the problem; the force that the first correction would take is.
  if (iterates.size() > 2) {
    const double first = std::max({iterates[0].norms.momentum_absolute, iterates[1].norms.momentum_absolute, stiffness * iterates[1].increment});
    if (last.norms.momentum_absolute > options.divergence * first)
      return StepFailure(FailureKind::diverged, fmt::format("|r| has grown from {:.2e} to {:.2e} in Newton iteration {}", first,
                                                            last.norms.momentum_absolute, last.iteration));
  }

  CycleDetector detector(options.cycle_length);
  for (const NewtonIteration& iterate : iterates) detector.add(iterate.norms.active_set, iterate.increment);
  if (const int length = detector.cycle(); length > 0)
    return StepFailure(FailureKind::cycling_active_set,
                       fmt::format("the active set repeats itself every {} Newton iterations ({} active nodes, {} changed last)", length,
                                   last.norms.active, last.norms.changed));

  if (wanders(iterates))
    return StepFailure(
        FailureKind::too_many_iterations,
        fmt::format("Newton's method wanders: after {} iterations the residual has never been below that of the start ({:.2e} now, {:.2e} "
                    "there), and {} of {} closed nodes still change their state",
                    last.iteration, last.norms.merit, iterates.front().norms.merit, last.norms.changed, last.norms.active));

  const int in_vain = iterations_without_progress(iterates);
  if (in_vain >= options.maximum_iterations) {
    std::string missed;
    for (const ConvergenceCriterion& criterion : criteria)
      if (!criterion.met(iterates)) missed += fmt::format("{}{}: {}", missed.empty() ? "" : ", ", criterion.name, criterion.value(last));
    return StepFailure(FailureKind::too_many_iterations,
                       fmt::format("not converged after {} Newton iterations{}; criteria that are not met: {}", last.iteration,
                                   in_vain < last.iteration ? fmt::format(", {} of them without progress", in_vain) : "", missed));
  }
  return std::nullopt;
}

NOX::StatusTest::StatusType GiveUpTest::check(const Iterates& iterates) {
  reason_ = reason_to_give_up(iterates, options_, criteria_, system_.stiffness_scale());
  return reason_ ? NOX::StatusTest::Failed : NOX::StatusTest::Unconverged;
}

}  // namespace mortise::detail
