#pragma once
// Conclusions of a study: orders, what is worth its time, the cheapest run that is good enough.

#include <optional>
#include <string>
#include <vector>

#include "mortise/studies/convergence.hpp"
#include "study/study_errors.hpp"

namespace mortise {

/// The conclusions from the errors of one quantity.
struct StudyConclusions {
  /// For one error that is aimed at.
  struct Target {
    double error = 0.0;
    std::optional<CheapestRun> cheapest;
    std::vector<std::optional<TimeToError>> times;  ///< of each curve
    std::vector<std::optional<double>> ratios;      ///< of these to that of the curve's base
  };
  std::optional<std::size_t> exact;  ///< the fastest run if all are exact but for round-off: it meets any bound
  std::vector<FittedOrder> orders;   ///< of each curve
  std::vector<std::size_t> front;    ///< points that no other is better than, in wall time and error
  std::vector<Target> targets;
};

StudyConclusions conclude(const StudyPlan& plan, const StudyResults& results, const std::vector<StudyCurve>& curves, const StudyErrors& errors);

/// "cheapest configuration within 1 % of peak_pressure: Q4, n = 8 (0.52 s); within 0.1 %: Q4, n = 16 (0.94 s, not confirmed by a finer run)"
/// "reaction: all runs are exact but for round-off; the fastest is Q4, n = 8 (0.52 s)"
std::string sentence(const StudyPlan& plan, const StudyResults& results, const StudyErrors& errors, const StudyConclusions& conclusions);

}  // namespace mortise
