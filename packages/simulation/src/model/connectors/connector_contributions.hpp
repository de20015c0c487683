#pragma once
// Springs and dashpots in the system of a scene.

#include <memory>

#include "model/connectors/step_velocity.hpp"
#include "model/contributions.hpp"
#include "mortise/solid/connectors.hpp"

namespace mortise {

/// Forces of all springs.
class SpringForces final : public CountedContribution {
 public:
  SpringForces(std::shared_ptr<const Connectors> springs, const Timers& timers)
      : CountedContribution("springs", timers), springs_(std::move(springs)) {}
  Kind kind() const override { return Kind::internal; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

 private:
  std::shared_ptr<const Connectors> springs_;
};

/// Forces of all dashpots. With inertia their velocities are those of the time scheme, in statics those of StepVelocity.
class DashpotForces final : public CountedContribution {
 public:
  DashpotForces(std::shared_ptr<const Connectors> dashpots, bool is_static, const Timers& timers);
  /// In statics they depend on time, and on what is committed.
  Kind kind() const override { return is_static_ ? Kind::interaction : Kind::internal; }
  FieldUse uses() const override;
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;
  void commit(const Configuration& at) override;
  void serialize(StateArchive& archive) override { memory_.serialize(archive, "dashpots"); }

  /// That their forces of the last accepted step come from, on owned dofs and ghosts.
  const Vector& last_velocity() const { return memory_.last(); }

 private:
  std::shared_ptr<const Connectors> dashpots_;
  bool is_static_;
  StepVelocity memory_;
};

}  // namespace mortise
