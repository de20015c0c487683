#include "mortise/nonlinear/load_stepper.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>

#include "mortise/nonlinear/step_schedule.hpp"
#include "repeated_course.hpp"

namespace mortise {
namespace {
constexpr double least_step = 1e-9;  // over the end time
}

void SteppingOptions::describe(Parameters& parameters) {
  parameters.add("end time", end_time, Says("pseudo-time at which the run ends; it starts at 0").unit("time").above(0.0));
  parameters.add("step", step, Says("first step, and the largest unless `maximum step` says otherwise").unit("time").above(0.0));
  parameters.add("maximum step", maximum_step, Says("largest step; default: `step`").unit("time").above(0.0));
  parameters.add("minimum step", minimum_step, Says("smallest step; the run stops if it fails; default: `step` / 1024").unit("time").above(0.0));
  parameters.add("easy iterations", easy_iterations,
                 Says("a step that took no more Newton iterations may be followed by one twice as long").at_least(0));
  parameters.add("output times", output_times, Says("times that are hit exactly").unit("time"));
  parameters.add(
      "predictor", predictor, {{"none", Predictor::none}, {"linear", Predictor::linear}},
      "where Newton's iterations start: at the last state, or at the line through the last two, which suits motion that goes on as before");
  if (!(step >= least_step * end_time))
    parameters.error("step",
                     fmt::format("is {} of an \"end time\" of {}; allowed: >= {} of it, a thousand million steps", step, end_time, least_step));
  if (maximum_step && *maximum_step < step) parameters.error("maximum step", fmt::format("is {}, smaller than \"step\", {}", *maximum_step, step));
  if (minimum_step && *minimum_step > step) parameters.error("minimum step", fmt::format("is {}, larger than \"step\", {}", *minimum_step, step));
  for (const double time : output_times)
    if (!(time > 0.0 && time <= end_time)) {
      parameters.error("output times", fmt::format("lie after 0 and not after \"end time\", {}; please remove {}", end_time, time));
      break;
    }
}

void store(StateArchive& archive, const SemiSmoothSystem& system, const SteppingState& state) {
  system.store(archive, state.accepted);
  int steps = state.steps;
  std::optional<double> next_step = state.next_step;
  serialize(archive, "steps", steps);
  serialize(archive, "next_step", next_step);
  int has_rate = state.rate.is_null() ? 0 : 1;
  serialize(archive, "has_rate", has_rate);
  if (has_rate == 0) return;
  Vector rate(*state.rate, Teuchos::Copy);
  serialize(archive, "rate", "unknowns", rate);
}

SteppingState restore_stepping(StateArchive& archive, const SemiSmoothSystem& system) {
  SteppingState state(system.restore(archive));
  serialize(archive, "steps", state.steps);
  serialize(archive, "next_step", state.next_step);
  int has_rate = 0;
  serialize(archive, "has_rate", has_rate);
  if (has_rate == 0) return state;
  const auto rate = rcp(new Vector(system.map()));
  serialize(archive, "rate", "unknowns", *rate);
  state.rate = rate;
  return state;
}

namespace {
/// Newton's method as often as a step needs it; `report` is that of all of them.
class StepSolver {
 public:
  StepSolver(const SemiSmoothSystem& system, const NewtonOptions& options, NewtonReport& report, std::optional<LinearisedIterate>& linearised,
             const std::function<void(const NewtonIteration&)>& observer)
      : system_(system), options_(options), report_(report), linearised_(linearised), observer_(observer) {
    report_ = {};
    report_.solves = 0;
  }

  /// And again as long as augmented Lagrange multipliers are updated. A solve that needed no Newton step found the conditions of the multipliers met
  /// as well as its tolerances tell: then further updates have no effect.
  SystemEvaluation solve(SystemEvaluation start) {
    NewtonReport next;
    for (int round = 0;; ++round) {
      const SystemEvaluation solution = solve_newton(system_, std::move(start), options_, next, observer_, &linearised_);
      report_.iterations.insert(report_.iterations.end(), next.iterations.begin(), next.iterations.end());
      ++report_.solves;
      std::optional<SystemEvaluation> updated;
      if (round == 0 || next.newton_steps() > 0) updated = system_.augment(solution, round + 1);
      if (!updated) return solution;
      start = *std::move(updated);
    }
  }

 private:
  const SemiSmoothSystem& system_;
  const NewtonOptions& options_;
  NewtonReport& report_;
  std::optional<LinearisedIterate>& linearised_;
  const std::function<void(const NewtonIteration&)>& observer_;
};

/// Whether F = 0 there to the tolerances: nothing that drives the bodies has changed. The Newton solve tests increments and states itself.
bool is_solution(const SystemEvaluation& at, const NewtonOptions& options) {
  const ResidualNorms& norms = at.norms();
  const bool balanced = norms.momentum <= options.momentum_tolerance || norms.momentum_absolute <= norms.round_off;
  return norms.finite && balanced && norms.prescribed <= options.increment_tolerance && norms.gap <= options.gap_tolerance &&
         norms.complementarity <= options.complementarity_tolerance;
}

/// Where the iterations of a try start: see run_steps().
SystemEvaluation start_of_try(const SemiSmoothSystem& system, const NewtonOptions& newton, const AcceptedState& state, const RCP<const Vector>& rate,
                              double time, const StepStart& start) {
  const auto context_of = [&](const Vector& d, Vector& z) { return start ? start(state, time, d, z) : system.step_from(state, time); };
  Vector x(*state.x, Teuchos::Copy);
  // Motion does not go on where the last state is a solution of this step too. Carried on all the same, it may end in another equilibrium.
  if (rate.is_null() || system.prescribed_deviation(*state.x, time) <= newton.increment_tolerance) {
    const StepContext context = context_of(*system.displacement(std::as_const(x)), *system.multipliers(x));
    SystemEvaluation at_rest = system.evaluate_at(state, *system.multipliers(std::as_const(x)), context);
    if (rate.is_null() || is_solution(at_rest, newton)) return at_rest;
  }
  x.update(1.0, *state.x, time - state.context.time, *rate, 0.0);
  const StepContext context = context_of(*system.displacement(std::as_const(x)), *system.multipliers(x));
  return system.evaluate(x, context);
}
}  // namespace

bool run_steps(const SemiSmoothSystem& system, const SteppingOptions& stepping, const NewtonOptions& newton, SteppingState& at,
               const StepStart& start, const StepperObserver& observer, std::optional<StepFailure>& last_failure) {
  StepSchedule schedule(stepping, at.accepted.context.time, at.next_step);
  while (!schedule.finished()) {
    const AcceptedState& state = at.accepted;
    const int step = at.steps + 1;
    StepReport report;
    report.step = step;
    detail::RepeatedCourse course;
    std::optional<SystemEvaluation> solution;
    while (!solution) {
      report.time = schedule.next_time();
      report.dt = report.time - schedule.time();
      StepContext context = system.step_from(state, report.time);
      std::optional<LinearisedIterate> linearised;
      bool solved = false;
      try {
        if (observer.begin) observer.begin(step, report.time, report.dt);
        StepSolver solver(system, newton, report.newton, linearised, observer.iteration);
        SystemEvaluation begin = start_of_try(system, newton, state, at.rate, report.time, start);
        if (const RCP<Vector> z = observer.close ? observer.close(begin) : Teuchos::null; !z.is_null()) begin = system.with_multipliers(begin, *z);
        context = begin.context();
        solution = solver.solve(std::move(begin));
        for (int round = 1; observer.verify; ++round) {
          solved = true;
          const RCP<Vector> other_start = observer.verify(state, *solution, round);
          if (other_start.is_null()) break;
          solved = false;
          context = solution->context();
          solution.reset();  // contact at an iterate takes memory
          solution = solver.solve(system.evaluate(*other_start, context));
        }
      } catch (const StepFailure& caught) {
        solution.reset();
        const std::string explanation = observer.explain && !solved ? observer.explain({caught, state, report.time, context, linearised}) : "";
        StepFailure failure = explanation.empty() ? caught : StepFailure(caught.kind(), fmt::format("{} ({})", explanation, caught.what()));
        const bool in_vain = course.add(caught, report.newton);
        if (in_vain)
          failure = StepFailure(failure.kind(),
                                fmt::format("{}; a smaller step is of no use: the last {} tries, each with half the step of the one before, "
                                            "went through the same states of contact",
                                            failure.what(), detail::RepeatedCourse::enough));
        last_failure = failure;
        ++report.cutbacks;
        report.undone.push_back(to_string(failure.kind()) + ": " + failure.what());
        if (observer.undone) observer.undone(report, failure);
        if (in_vain || caught.kind() == FailureKind::out_of_memory || !schedule.cut()) return false;
      }
    }
    last_failure.reset();
    AcceptedState next = system.commit(*solution);
    if (stepping.predictor == Predictor::linear) {
      const auto rate = rcp(new Vector(system.map()));
      rate->update(1.0 / report.dt, *next.x, -1.0 / report.dt, *state.x, 0.0);
      if (observer.predict) observer.predict(*next.x, report.dt, *rate);
      at.rate = rate;
    }
    at.accepted = std::move(next);
    schedule.accept(report.newton.newton_steps() <= stepping.easy_iterations);
    at.steps = step;
    at.next_step = schedule.next_step();
    if (observer.accepted) observer.accepted(report, *solution);
    solution.reset();  // a state that is stored takes memory
    if (observer.rest && observer.rest(at) && !schedule.finished()) return false;
  }
  return true;
}

}  // namespace mortise
