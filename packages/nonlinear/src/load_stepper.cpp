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

namespace {
/// Newton's method as often as a step needs it; `report` is that of all of them.
class StepSolver {
 public:
  StepSolver(SemiSmoothSystem& system, double time, const NewtonOptions& options, NewtonReport& report,
             const std::function<void(const NewtonIteration&)>& observer)
      : system_(system), time_(time), options_(options), report_(report), observer_(observer) {
    report_ = {};
    report_.solves = 0;
  }

  /// And again as long as augmented Lagrange multipliers are updated. A solve that needed no Newton step found the conditions of the multipliers met
  /// as well as its tolerances tell: then further updates have no effect.
  void solve(Vector& x) {
    int round = 0;
    NewtonReport next;
    do {
      solve_newton(system_, time_, options_, x, next, observer_);
      report_.iterations.insert(report_.iterations.end(), next.iterations.begin(), next.iterations.end());
      ++report_.solves;
    } while ((round == 0 || next.newton_steps() > 0) && system_.augment(x, ++round));
  }

 private:
  SemiSmoothSystem& system_;
  double time_;
  const NewtonOptions& options_;
  NewtonReport& report_;
  const std::function<void(const NewtonIteration&)>& observer_;
};

/// Whether F(x) = 0 at `time` to the tolerances: nothing that drives the bodies has changed. The Newton solve tests increments and states itself.
bool is_solution(SemiSmoothSystem& system, const NewtonOptions& options, const Vector& x) {
  Vector F(system.map());
  ResidualNorms norms;
  system.residual(x, F, norms);
  const bool balanced = norms.momentum <= options.momentum_tolerance || norms.momentum_absolute <= norms.round_off;
  return norms.finite && balanced && norms.prescribed <= options.increment_tolerance && norms.gap <= options.gap_tolerance &&
         norms.complementarity <= options.complementarity_tolerance;
}
}  // namespace

bool run_steps(SemiSmoothSystem& system, const SteppingOptions& stepping, const NewtonOptions& newton, Vector& x,
               const std::function<void(Vector& x)>& start_step, const StepperObserver& observer, std::optional<StepFailure>& last_failure) {
  StepSchedule schedule(stepping);
  Vector tried(x.getMap());
  RCP<Vector> rate;  // of the last accepted step
  for (int step = 1; !schedule.finished(); ++step) {
    StepReport report;
    report.step = step;
    detail::RepeatedCourse course;
    for (;;) {
      report.time = schedule.next_time();
      report.dt = report.time - schedule.time();
      Tpetra::deep_copy(tried, x);
      bool solved = false;
      try {
        if (observer.begin) observer.begin(step, report.time, report.dt);
        system.set_time(report.time);
        // Motion does not go on where the last state is a solution of this step too. Carried on all the same, it may end in another equilibrium.
        const bool may_rest = rate.is_null() || system.prescribed_deviation(x) <= newton.increment_tolerance;
        if (may_rest && start_step) start_step(tried);
        if (!rate.is_null() && (!may_rest || !is_solution(system, newton, tried))) {
          tried.update(1.0, x, report.dt, *rate, 0.0);
          if (start_step) start_step(tried);
        }
        StepSolver solver(system, report.time, newton, report.newton, observer.iteration);
        for (int round = 1;; ++round) {
          solver.solve(tried);
          solved = true;
          if (!observer.verify || observer.verify(x, tried, round)) break;
          solved = false;
        }
        break;
      } catch (const StepFailure& caught) {
        const std::string explanation = observer.explain && !solved ? observer.explain(caught) : "";
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
        if (in_vain || !schedule.cut()) return false;
      }
    }
    last_failure.reset();
    system.commit(tried);
    if (stepping.predictor == Predictor::linear) {
      if (rate.is_null()) rate = rcp(new Vector(x.getMap()));
      rate->update(1.0 / report.dt, tried, -1.0 / report.dt, x, 0.0);
      if (observer.predict) observer.predict(tried, report.dt, *rate);
    }
    Tpetra::deep_copy(x, tried);
    schedule.accept(report.newton.newton_steps() <= stepping.easy_iterations);
    if (observer.accepted) observer.accepted(report, x);
  }
  return true;
}

}  // namespace mortise
