#pragma once
// Inertia and damping of a scene's bodies.

#include <memory>

#include "model/contributions.hpp"
#include "mortise/simulation/model/inertia_of_model.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// M a + a_R M v, a_R the mass damping.
class InertiaContribution final : public CountedContribution {
 public:
  InertiaContribution(std::shared_ptr<const NodalMass> mass, double damping, const Timers& timers)
      : CountedContribution("inertia", timers), mass_(std::move(mass)), damping_(damping) {}
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override;
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

 private:
  std::shared_ptr<const NodalMass> mass_;
  double damping_;
};

/// b K_0 v, K_0 the stiffness of the bodies at the start (Rayleigh damping).
class StiffnessDamping final : public CountedContribution {
 public:
  StiffnessDamping(const Bodies& bodies, double damping, const Timers& timers);
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override;
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

  RCP<const Matrix> matrix() const { return damping_; }

 private:
  RCP<Matrix> damping_;  ///< b K_0
};

/// Gives a system time integration, inertia and damping, as the scene says, and the graph that mass needs. Collective.
/// @param prescribed  owned dofs, ascending
/// @throws InputError on all ranks for bodies without density, rigid bodies that move without mass
InertiaOfModel add_inertia(const Scene& scene, const std::shared_ptr<const Bodies>& bodies, const std::vector<LocalOrdinal>& prescribed,
                           const Timers& timers, SystemParts& parts);

}  // namespace mortise
