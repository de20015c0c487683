#include "run/stepping/step_guard.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mortise {
namespace {

/// The first answer of a guard that is not null.
template <class Ask>
RCP<Vector> first_answer(const StepGuards& guards, const Ask& ask) {
  for (const auto& guard : guards)
    if (const RCP<Vector> answer = ask(*guard); !answer.is_null()) return answer;
  return Teuchos::null;
}

FailureExplanation explain_all(const StepGuards& guards, const SemiSmoothSystem& system, const FailedTry& failed) {
  FailureExplanation all;
  for (const auto& guard : guards) {
    FailureExplanation one;
    try {
      one = guard->explain(system, failed);
    } catch (const StepFailure&) {  // on every rank: an iterate that cannot be evaluated explains nothing
    }
    if (!one.words.empty()) all.words += (all.words.empty() ? "" : "; ") + one.words;
    all.at_any_step = all.at_any_step || one.at_any_step;
  }
  return all;
}

}  // namespace

void guard_steps(StepperObserver& observer, const StepGuards& guards, const SemiSmoothSystem& system) {
  observer.begin = [&, before = observer.begin](int step, double time, double dt) {
    for (const auto& guard : guards) guard->begin();
    if (before) before(step, time, dt);
  };
  observer.close = [&](const SystemEvaluation& start) { return first_answer(guards, [&](StepGuard& guard) { return guard.close(system, start); }); };
  observer.verify = [&](const AcceptedState& from, const SystemEvaluation& found, int round) {
    return first_answer(guards, [&](StepGuard& guard) { return guard.verify(system, from, found, round); });
  };
  observer.explain = [&](const FailedTry& failed) { return explain_all(guards, system, failed); };
  observer.predict = [&](const Vector& x, double dt, Vector& rate) {
    for (const auto& guard : guards) guard->predict(system, x, dt, rate);
  };
  observer.growth = [&]() {
    std::optional<double> least;
    for (const auto& guard : guards)
      if (const auto growth = guard->growth()) least = std::min(least.value_or(*growth), *growth);
    return least;
  };
  observer.accepted = [&, accepted = observer.accepted](const StepReport& report, const SystemEvaluation& at) {
    for (const auto& guard : guards) guard->accept(system, at);
    if (accepted) accepted(report, at);
  };
}

std::optional<StepFailure> end_steps(const StepGuards& guards, const SemiSmoothSystem& system, EndOfSteps end) {
  std::optional<StepFailure> failure;
  for (const auto& guard : guards) {
    std::optional<StepFailure> found = guard->end(system, end);
    if (!found || failure) continue;
    failure.emplace(*std::move(found));
    end.is_converged = false;
  }
  return failure;
}

}  // namespace mortise
