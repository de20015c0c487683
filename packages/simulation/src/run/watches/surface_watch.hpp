#pragma once
// Checks of a state by the surfaces of the bodies, for what contact alone does not see.

#include <functional>
#include <string>

#include "run/stepping/step_guard.hpp"
#include "run/watches/contact_watch.hpp"
#include "run/watches/corner_watch.hpp"
#include "run/watches/lean_watch.hpp"
#include "run/watches/overlap_watch.hpp"

namespace mortise {

/// Looks at each converged state once. It asks whether a body has passed through another, whether a corner lies within a facet, whether bodies
/// overlap although their pair carries no force, and whether leaning normals bear what friction does not.
class SurfaceWatch final : public StepGuard {
 public:
  /// @param warn  called once for each pair and question
  SurfaceWatch(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn);

  /// @throws StepFailure on every rank, as ContactWatch says
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  /// On its way in a corner passes through a part of a facet before contact begins; a run that ends there has not found its force.
  std::optional<StepFailure> end(const SemiSmoothSystem& system, const EndOfSteps& end) override;
  void serialize(StateArchive& archive) override;

 private:
  const Model& model_;
  ContactWatch passages_;
  CornerWatch corners_;
  OverlapWatch overlaps_;
  LeanWatch leans_;
};

}  // namespace mortise
