#pragma once
// Jumps of the velocity of prescribed displacements.

#include <functional>
#include <memory>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Warns once where a prescribed velocity jumps: Newmark's formulas then give accelerations that ring. A jump is looked for among the slopes of
/// quarters of a step and of the quarter before it. One between two quarters shares itself among two differences.
class PrescribedVelocityGuard final : public StepGuard {
 public:
  /// Collective.
  PrescribedVelocityGuard(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  void serialize(StateArchive& archive) override;

 private:
  const Model& model_;
  std::function<void(const std::string&)> warn_;
  double largest_ = 0.0;  ///< velocity over the run, of coarse differences
  bool is_said_ = false;
};

}  // namespace mortise
