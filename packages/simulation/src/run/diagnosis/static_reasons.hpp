#pragma once
// Reasons of failed steps of a static analysis: of several, the surest one that is known.

#include <memory>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "run/diagnosis/explain_statics.hpp"
#include "run/diagnosis/slip_settlement.hpp"
#include "run/diagnosis/state_check.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Smaller tries of a step often end where less can be told: then what an earlier one showed is said again.
class StaticReasons final : public StepGuard {
 public:
  /// @param check       null: no body is held by contact alone
  /// @param settlement  null: nor is any by friction
  StaticReasons(const Model& model, const SteppingOptions& stepping, std::shared_ptr<const StateCheck> check,
                std::shared_ptr<const SlipSettlement> settlement)
      : model_(model),
        smallest_(stepping.minimum_step.value_or(stepping.step / 1024.0)),
        check_(std::move(check)),
        settlement_(std::move(settlement)) {}

  FailureExplanation explain(const SemiSmoothSystem& system, const FailedTry& failed) override;
  void accept(const SemiSmoothSystem&, const SystemEvaluation&) override { known_.clear(); }

 private:
  /// Empty: nothing shows in this try.
  std::string reason(const SemiSmoothSystem& system, const FailedTry& failed, const StaticsReason& statics) const;

  const Model& model_;
  double smallest_;
  std::shared_ptr<const StateCheck> check_;
  std::shared_ptr<const SlipSettlement> settlement_;
  std::string known_;  ///< of earlier tries of the step
};

}  // namespace mortise
