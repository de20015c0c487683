#include "study/study_conclusions.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mortise {
namespace {

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& indices) {
  std::vector<double> some;
  for (const std::size_t i : indices) some.push_back(values[i]);
  return some;
}

/// The fastest run if no error that is known is more than round-off.
std::optional<std::size_t> fastest_of_exact(const std::vector<double>& seconds, const std::vector<double>& errors) {
  std::optional<std::size_t> fastest;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!std::isfinite(errors[i]) || !std::isfinite(seconds[i])) continue;
    if (errors[i] > round_off) return {};
    if (!fastest || seconds[i] < seconds[*fastest]) fastest = i;
  }
  return fastest;
}

}  // namespace

StudyConclusions conclude(const StudyPlan& plan, const StudyResults& results, const std::vector<StudyCurve>& curves, const StudyErrors& errors) {
  std::vector<double> seconds;
  for (const StudyRecord& point : results.points) seconds.push_back(point.wall);
  std::vector<std::vector<std::size_t>> families;
  for (const StudyCurve& curve : curves) families.push_back(curve.points);
  StudyConclusions conclusions;
  conclusions.exact = fastest_of_exact(seconds, errors.error);
  conclusions.front = pareto_front(seconds, errors.error);
  for (const StudyCurve& curve : curves)
    conclusions.orders.push_back(fitted_order(picked(results.h, curve.points), picked(errors.error, curve.points)));
  for (const double error : plan.file.targets) {
    StudyConclusions::Target target;
    target.error = error;
    target.cheapest = conclusions.exact ? CheapestRun{*conclusions.exact, true} : cheapest_run(error, seconds, errors.error, families);
    for (const StudyCurve& curve : curves)
      target.times.push_back(time_to_error(error, picked(seconds, curve.points), picked(errors.error, curve.points)));
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const auto &time = target.times[c], &base = target.times[curves[c].base];
      const bool exact = time && base && !time->at_most && !base->at_most;
      target.ratios.push_back(exact ? std::optional<double>(time->seconds / base->seconds) : std::nullopt);
    }
    conclusions.targets.push_back(std::move(target));
  }
  return conclusions;
}

std::string sentence(const StudyPlan& plan, const StudyResults& results, const StudyErrors& errors, const StudyConclusions& conclusions) {
  if (conclusions.exact)
    return fmt::format("{}: all runs are exact but for round-off; the fastest is {} ({:.3g} s)", errors.name, plan.points[*conclusions.exact].label(),
                       results.points[*conclusions.exact].wall);
  std::string text = "cheapest configuration";
  for (const auto& target : conclusions.targets) {
    const bool first = &target == &conclusions.targets.front();
    const std::string within = fmt::format("within {:g} %{}", 100.0 * target.error, first ? " of " + errors.name : "");
    text += first ? " " + within + ": " : "; " + within + ": ";
    text += target.cheapest ? fmt::format("{} ({:.3g} s{})", plan.points[target.cheapest->run].label(), results.points[target.cheapest->run].wall,
                                          target.cheapest->confirmed ? "" : ", not confirmed by a finer run")
                            : "none";
  }
  return text;
}

}  // namespace mortise
