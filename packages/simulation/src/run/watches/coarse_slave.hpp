#pragma once
// Forces on so few slave nodes that the master's curvature within their facets decides on approach and pressure.

#include <functional>
#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Remembers of each pair the accepted state in which it pressed hardest, and what was wrong with it.
class CoarseSlaveWatch final : public StepGuard {
 public:
  /// @param warn  gets one line for each pair with too coarse a slave where it pressed hardest, or in the last state
  CoarseSlaveWatch(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

  /// Why Newton's method found no equilibrium, if contact was sought at a node or two whose facets are too coarse for the master.
  FailureExplanation explain(const SemiSmoothSystem& system, const FailedTry& failed) override;
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  std::optional<StepFailure> end(const SemiSmoothSystem& system, const EndOfSteps& end) override;
  void serialize(StateArchive& archive) override;

 private:
  struct Hardest {
    double pressure = 0.0;  ///< largest of a node
    std::string words;      ///< what is wrong with that state; empty: nothing
  };

  const Model& model_;
  const Scene& scene_;
  std::function<void(const std::string&)> warn_;
  std::vector<Hardest> hardest_;  ///< [pairs of the scene]
};

}  // namespace mortise
