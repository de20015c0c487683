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
/// constant over a step with massive contact nodes, or of normals that turn. K + S - W, of kinetic energy K and work S on bodies, is what the start,
/// loads and supports have given less what was dissipated. At the end of a run the guard warns where W has risen by a share of the largest K + S - W,
/// and refuses the end state where it has risen by all of it.
class ContactWorkGuard final : public StepGuard {
 public:
  ContactWorkGuard(const Model& model, std::function<void(const std::string&)> warn)
      : mass_(model.inertia().mass),
        warn_(std::move(warn)),
        force_(rcp(new Vector(model.parts().dofs))),
        internal_(rcp(new Vector(model.parts().dofs))) {}

  RCP<Vector> verify(const SemiSmoothSystem& system, const AcceptedState& from, const SystemEvaluation& found, int round) override;
  void accept(const SemiSmoothSystem& system, const SystemEvaluation& at) override;
  std::optional<StepFailure> end(const SemiSmoothSystem& system, const EndOfSteps& end) override;
  void serialize(StateArchive& archive) override;

 private:
  std::shared_ptr<const NodalMass> mass_;
  std::function<void(const std::string&)> warn_;
  double work_ = 0.0, least_ = 0.0, rise_ = 0.0;  ///< of accepted states: W, the least that it was, the largest W less its least before
  double strain_ = 0.0, given_ = 0.0;             ///< S; largest |K + S - W|
  RCP<Vector> force_, internal_;                  ///< of contact and of the bodies in the accepted state; at the start 0
  double next_work_ = 0.0, next_strain_ = 0.0;    ///< of the state that was verified last
  RCP<Vector> next_force_, next_internal_;
};

}  // namespace mortise
