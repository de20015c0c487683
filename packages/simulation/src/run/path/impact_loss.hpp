#pragma once
// Energy that contact takes by closing within a step.

#include <memory>

#include "mortise/solid/nodal_mass.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Nodes that close within a step give up sum z_n g_n, g_n their gaps at its start: what pressures take, f_n . (d - d_old). A step in which that is
/// more than a share of the largest kinetic energy so far is undone.
class ImpactLossGuard final : public StepGuard {
 public:
  ImpactLossGuard(std::shared_ptr<const NodalMass> mass, double tolerance) : mass_(std::move(mass)), tolerance_(tolerance) {}

  /// @throws StepFailure(step_error) on every rank
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  void serialize(StateArchive& archive) override;

 private:
  std::shared_ptr<const NodalMass> mass_;
  double tolerance_;
  double largest_ = 0.0;  ///< kinetic energy of accepted states
};

}  // namespace mortise
