#pragma once
// Energy that contact gives, by errors of time integration.

#include <functional>
#include <memory>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "mortise/solid/nodal_mass.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// Contact takes energy or leaves it. Work W of the contact forces on all bodies that rises above what it was is an error: of forces that are not
/// constant over a step with massive contact nodes, or of normals that turn. With E the largest kinetic energy, or strain energy if that is more, so
/// far, the guard warns once where W has risen by a share of E, and undoes a step in which it would rise by E.
class ContactWorkGuard final : public StepGuard {
 public:
  ContactWorkGuard(const Model& model, std::function<void(const std::string&)> warn)
      : mass_(model.inertia().mass), warn_(std::move(warn)), force_(rcp(new Vector(model.parts().dofs))) {}

  /// @throws StepFailure(step_error) on every rank
  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  void serialize(StateArchive& archive) override;

 private:
  std::shared_ptr<const NodalMass> mass_;
  std::function<void(const std::string&)> warn_;
  double work_ = 0.0, least_ = 0.0;      ///< of accepted states: W, and the least that it was
  double strain_ = 0.0, largest_ = 0.0;  ///< work of internal forces; E
  bool is_said_ = false;
  RCP<Vector> force_;                           ///< contact forces of the accepted state; at the start 0
  double next_work_ = 0.0, next_strain_ = 0.0;  ///< of the state that was verified last
  RCP<Vector> next_force_;
};

}  // namespace mortise
