#pragma once
// Checks of the heat of each step: balance, temperatures below all that cause them.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/heat_balance.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Ends a run whose heat is not in balance, and warns once of temperatures that undershoot.
class HeatWatch final : public StepGuard {
 public:
  HeatWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);
  /// Pairs whose heat sets in at once where they touch, while bodies expand: contact that closes cools and opens, and a state between need not exist
  /// (Barber 1978, Z. angew. Math. Phys. 29, 813: with a resistance that depends on the pressure one does).
  FailureExplanation explain(const SemiSmoothSystem& system, const FailedTry& failed) override;
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  std::optional<StepFailure> end(const SemiSmoothSystem& system, const EndOfSteps& steps) override;
  void serialize(StateArchive& archive) override;

 private:
  void look_for_undershoot(const SemiSmoothSystem& system, const SystemEvaluation& at);

  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  HeatBalance balance_;
  double worst_ = 0.0, time_of_worst_ = 0.0;  ///< imbalance over the largest power
  double last_time_ = 0.0;
  bool is_said_ = false;
  bool stores_everywhere_ = true;          ///< no body without a specific heat
  std::vector<std::string> undetermined_;  ///< bodies whose temperature nothing determined in an accepted state
  double time_undetermined_ = 0.0;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;  ///< of what causes temperatures; infinite: not known
};

}  // namespace mortise
