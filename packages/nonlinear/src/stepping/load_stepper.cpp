#include "mortise/nonlinear/load_stepper.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>

#include "mortise/nonlinear/step_schedule.hpp"
#include "stepping/repeated_course.hpp"

namespace mortise {
namespace {
constexpr double least_step = 1e-9;  // over the end time
}

void SteppingOptions::describe(Parameters& parameters) {
  parameters.add("end time", end_time, Says("pseudo-time at which the run ends; it starts at 0").unit("time").above(0.0));
  parameters.add("step", step, Says("first step, and the largest unless `maximum step` says otherwise").unit("time").above(0.0));
  parameters.add("maximum step", maximum_step, Says("largest step; default: `step`").unit("time").above(0.0));
  parameters.add("minimum step", minimum_step, Says("smallest step; the run stops if it fails; default: `step` / 1024").unit("time").above(0.0));
  parameters.add("easy iterations", easy_iterations, Says("most Newton iterations of a step that may be followed by one twice as long").at_least(0));
  parameters.add("output times", output_times, Says("times that are hit exactly").unit("time"));
  parameters.add("predictor", predictor, {{"none", Predictor::none}, {"linear", Predictor::linear}},
                 "start of Newton's iterations: the last state, or the line through the last two, which suits motion that goes on as before");
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
  double last_step = state.last_step;
  serialize(archive, "last_step", last_step);
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
  serialize(archive, "last_step", state.last_step);
  return state;
}

namespace {
/// The observer ends the run within a step.
struct Interrupted {};

/// True if F = 0 there to the tolerances: nothing that drives the bodies has changed. The Newton solve tests increments and states itself.
bool is_solution(const SystemEvaluation& at, const NewtonOptions& options) {
  const ResidualNorms& norms = at.norms();
  const bool balanced = norms.momentum <= options.momentum_tolerance || norms.momentum_absolute <= norms.round_off;
  return norms.finite && balanced && norms.prescribed <= options.increment_tolerance && norms.gap <= options.gap_tolerance &&
         norms.complementarity <= options.complementarity_tolerance;
}

/// Newton's method as often as a step needs it; `report` is that of all of them.
class StepSolver {
 public:
  StepSolver(const SemiSmoothSystem& system, const NewtonOptions& options, NewtonReport& report, std::optional<LinearisedIterate>& linearised,
             const std::function<void(const NewtonIteration&)>& observer)
      : system_(system), options_(options), report_(report), linearised_(linearised), observer_(observer) {
    report_ = {};
    report_.solves = 0;
  }

  /// All fields together, or each by itself, with the others as they are, in turn until all are in balance.
  SystemEvaluation solve(SystemEvaluation start) {
    const std::size_t fields = system_.parts().fields.size();
    if (options_.fields == FieldSolution::monolithic || fields < 2) return solve_together(std::move(start));
    for (int turn = 1; turn <= options_.most_turns; ++turn) {
      for (std::size_t field = 0; field < fields; ++field) start = solve_together(system_.solving_for(start, field));
      start = system_.solving_for(start, std::nullopt);
      if (is_solution(start, options_)) return start;
    }
    throw StepFailure(FailureKind::too_many_iterations,
                      fmt::format("the fields are not in balance with one another after {} turns: the relative residual is {:.2e} of {:.1e}; take "
                                  "\"fields\" \"monolithic\", or smaller steps",
                                  options_.most_turns, start.norms().momentum, options_.momentum_tolerance));
  }

 private:
  /// And again as long as augmented Lagrange multipliers are updated. A solve that needed no Newton step found the conditions of the multipliers met
  /// as well as its tolerances tell: then further updates have no effect.
  SystemEvaluation solve_together(SystemEvaluation start) {
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

  const SemiSmoothSystem& system_;
  const NewtonOptions& options_;
  NewtonReport& report_;
  std::optional<LinearisedIterate>& linearised_;
  const std::function<void(const NewtonIteration&)>& observer_;
};

/// Merit of a predicted start over that of the last state beyond which the prediction is not taken.
constexpr double far_off = 1e3;

/// Factor of the complementarity constants with which a try is repeated whose states of contact run in circles.
constexpr double careful = 0.01;

/// Options of the start of a try.
struct TryOptions {
  bool may_predict;
  double constant_share = 1.0;  ///< SemiSmoothSystem::weigh_gaps()
};

/// Where the iterations of a try start.
struct Begin {
  SystemEvaluation at;
  bool is_predicted;
};

/// See run_steps().
Begin begin_of_try(const SemiSmoothSystem& system, const NewtonOptions& newton, const SteppingState& from, double time, const TryOptions& options,
                   const StepStart& start) {
  const AcceptedState& state = from.accepted;
  const double now = state.context.time;
  const auto prepared = [&](Vector& x) {
    const RCP<const Vector> d = system.unknowns(std::as_const(x));
    StepContext context = start ? start(state, time, *d, *system.multipliers(x)) : system.step_from(state, time);
    return options.constant_share == 1.0 ? context : system.weigh_gaps(std::move(context), options.constant_share);
  };
  std::optional<SystemEvaluation> rest;
  const auto at_rest = [&]() -> const SystemEvaluation& {
    if (!rest) {
      Vector x(*state.x, Teuchos::Copy);
      const StepContext context = prepared(x);
      rest = system.evaluate_at(state, *system.multipliers(std::as_const(x)), context);
    }
    return *rest;
  };
  if (!options.may_predict) return {at_rest(), false};
  if (system.parts().time) {
    Vector x(*state.x, Teuchos::Copy);
    Tpetra::deep_copy(*system.unknowns(x), *predicted_unknowns(*system.step_from(state, time).step));
    const StepContext context = prepared(x);
    return {system.evaluate(x, context, StiffnessIs::needed_next), true};
  }
  const Drive drive = system.drive(*state.x, now, time);
  const std::optional<double> share = drive.continuation(system.drive(*state.x, now - from.last_step, now));
  const double length = std::min(time - now, share ? *share * from.last_step : time - now);
  if (length == 0.0) return {at_rest(), false};
  // The drive of the last step is not known, as where clearances changed. Motion does not go on if the last state is a solution of this step too.
  if (!share && system.prescribed_deviation(*state.x, time) <= newton.increment_tolerance && is_solution(at_rest(), newton)) return {*rest, false};
  Vector x(*state.x, Teuchos::Copy);
  x.update(length, *from.rate, 1.0);
  const StepContext context = prepared(x);
  SystemEvaluation predicted = system.evaluate(x, context, StiffnessIs::needed_next);
  // The last state lacks at least what drives the step.
  const auto is_far_off = [&](double merit) { return !(predicted.norms().merit <= far_off * merit); };
  if (drive.strength() > 0.0 && is_far_off(drive.strength()) && is_far_off(at_rest().norms().merit)) return {*rest, false};
  return {std::move(predicted), true};
}

/// Newton steps that say how hard a step was: all of them, and of fields in turn those of the hardest solve, or the number of solves for each field.
int hardness(const NewtonReport& report, const NewtonOptions& newton, std::size_t fields) {
  if (newton.fields == FieldSolution::monolithic || fields < 2) return report.newton_steps();
  int hardest = report.solves / static_cast<int>(fields);
  for (const NewtonIteration& iteration : report.iterations) hardest = std::max(hardest, iteration.iteration);
  return hardest;
}

/// Length of the next step over that of the last one. Without tolerances a step of time only grows back to the first one.
double growth_of_step(const SemiSmoothSystem& system, const SteppingOptions& stepping, const StepperObserver& observer, const StepReport& report,
                      const NewtonOptions& newton, double next_step) {
  if (observer.growth)
    if (const std::optional<double> growth = observer.growth()) return *growth;
  const bool easy = hardness(report.newton, newton, system.parts().fields.size()) <= stepping.easy_iterations;
  return easy && (!system.parts().time || next_step < stepping.step) ? 2.0 : 1.0;
}

}  // namespace

bool run_steps(const SemiSmoothSystem& system, const SteppingOptions& stepping, const NewtonOptions& newton, SteppingState& at,
               const StepStart& start, const StepperObserver& observer, std::optional<StepFailure>& last_failure) {
  StepSchedule schedule(stepping, at.accepted.context.time, at.next_step);
  const std::function<void(const NewtonIteration&)> iteration = [&](const NewtonIteration& done) {
    if (observer.iteration) observer.iteration(done);
    if (observer.interrupted && observer.interrupted()) throw Interrupted();
  };
  while (!schedule.finished()) {
    const AcceptedState& state = at.accepted;
    const int step = at.steps + 1;
    StepReport report;
    report.step = step;
    detail::RepeatedCourse course;
    int at_any_step = 0;  // tries in a row with such an explanation
    std::optional<SystemEvaluation> solution;
    const bool may_predict = system.parts().time ? stepping.predictor == Predictor::linear : !at.rate.is_null();
    TryOptions next_try{may_predict};
    bool may_be_careful = system.parts().contact != nullptr;
    while (!solution) {
      report.time = schedule.next_time();
      report.dt = report.time - schedule.time();
      StepContext context = system.step_from(state, report.time);
      std::optional<LinearisedIterate> linearised;
      bool solved = false, is_predicted = false;
      try {
        if (observer.begin) observer.begin(step, report.time, report.dt);
        StepSolver solver(system, newton, report.newton, linearised, iteration);
        Begin begin = begin_of_try(system, newton, at, report.time, next_try, start);
        is_predicted = begin.is_predicted;
        if (const RCP<Vector> z = observer.close ? observer.close(begin.at) : Teuchos::null; !z.is_null())
          begin.at = system.with_multipliers(begin.at, *z);
        context = begin.at.context();
        solution = solver.solve(std::move(begin.at));
        for (int round = 1; observer.verify; ++round) {
          solved = true;
          const RCP<Vector> other_start = observer.verify(state, *solution, round);
          if (other_start.is_null()) break;
          solved = false;
          context = solution->context();
          solution.reset();  // contact at an iterate takes memory
          solution = solver.solve(system.evaluate(*other_start, context));
        }
      } catch (const Interrupted&) {  // on every rank
        last_failure.reset();
        return false;
      } catch (const StepFailure& caught) {
        solution.reset();
        const FailureExplanation explanation =
            observer.explain && !solved ? observer.explain({caught, state, report.time, context, linearised}) : FailureExplanation{};
        StepFailure failure =
            explanation.words.empty() ? caught : StepFailure(caught.kind(), fmt::format("{} ({})", explanation.words, caught.what()));
        const bool leaves_prediction = solved && is_predicted && caught.kind() != FailureKind::step_error;
        at_any_step = explanation.at_any_step ? at_any_step + 1 : 0;
        const bool repeats = !leaves_prediction && course.add(caught, report.newton);
        const bool in_vain = repeats || at_any_step >= detail::RepeatedCourse::enough;
        if (in_vain)
          failure = StepFailure(failure.kind(),
                                fmt::format("{}; a smaller step is of no use: the last {} tries, each with half the step of the one before, "
                                            "went the same way",
                                            failure.what(), detail::RepeatedCourse::enough));
        last_failure = failure;
        ++report.cutbacks;
        report.undone.push_back(to_string(failure.kind()) + ": " + failure.what());
        if (observer.undone) observer.undone(report, failure);
        if (in_vain || caught.kind() == FailureKind::out_of_memory) return false;
        // A refused state that a prediction led to says nothing about the state that the last one leads to. Where it led nowhere a smaller step
        // starts at the last state, and after that with a prediction again.
        if (leaves_prediction)
          next_try.may_predict = false;
        else if (caught.kind() == FailureKind::cycling_active_set && may_be_careful) {
          next_try.constant_share = careful;
          may_be_careful = false;
        } else if (schedule.cut())
          next_try = {may_predict && (!is_predicted || system.parts().time)};
        else
          return false;
      }
    }
    last_failure.reset();
    AcceptedState next = system.commit(*solution);
    const double growth = growth_of_step(system, stepping, observer, report, newton, schedule.next_step());
    if (stepping.predictor == Predictor::linear && !system.parts().time) {
      const auto rate = rcp(new Vector(system.map()));
      rate->update(1.0 / report.dt, *next.x, -1.0 / report.dt, *state.x, 0.0);
      if (observer.predict) observer.predict(*next.x, report.dt, *rate);
      at.rate = rate;
      at.last_step = report.dt;
    }
    at.accepted = std::move(next);
    schedule.accept(growth);
    at.steps = step;
    at.next_step = schedule.next_step();
    if (observer.accepted) observer.accepted(report, *solution);
    solution.reset();  // a state that is stored takes memory
    if (observer.rest && observer.rest(at) && !schedule.finished()) return false;
  }
  return true;
}

}  // namespace mortise
