#include "run/diagnosis/static_reasons.hpp"

#include <fmt/format.h>

#include "run/diagnosis/explain_failure.hpp"
#include "run/path/limit_load.hpp"
#include "run/path/turning_point.hpp"

namespace mortise {

std::string StaticReasons::reason(const SemiSmoothSystem& system, const FailedTry& failed, const StaticsReason& statics) const {
  if (statics.verdict == StaticsVerdict::falls) return statics.words;
  if (failed.time - failed.from.context.time < 2.0 * smallest_)
    if (std::string turns = explain_turning_point(failed, model_, system); !turns.empty()) return turns;
  if (check_ && !check_->refused().empty()) return check_->refused() + "; put back, it found no equilibrium";
  // What Newton's last iterate says of motions is no reason where statics says that contact can hold the bodies.
  std::string words;
  if (statics.verdict == StaticsVerdict::unknown) {
    if (settlement_) words = settlement_->overload();
    if (words.empty() && check_) words = explain_failure(failed, model_, system, check_->record());
  }
  return words.empty() ? explain_limit_load(failed, model_, system) : words;
}

FailureExplanation StaticReasons::explain(const SemiSmoothSystem& system, const FailedTry& failed) {
  if (failed.failure.kind() == FailureKind::input || failed.failure.kind() == FailureKind::out_of_memory) return {};
  const StaticsReason statics = check_ ? explain_statics(model_, system, *failed.from.x, failed.context) : StaticsReason{};
  if (const std::string words = reason(system, failed, statics); !words.empty()) return {known_ = words};
  if (!known_.empty()) return {known_ + "; so an earlier try of this step"};
  if (!check_) return {};
  const std::string held = describe_held_bodies(failed, model_, system, check_->record());
  if (statics.verdict == StaticsVerdict::unknown) return {held};
  return {fmt::format("{}; Newton's method found no equilibrium; {}", statics.words, held)};
}

}  // namespace mortise
