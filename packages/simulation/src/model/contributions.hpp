#pragma once
// Contributions to the nonlinear system that `solid` computes.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/timers.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/solid/bodies.hpp"
#include "mortise/solid/followers.hpp"
#include "mortise/solid/full_turns.hpp"
#include "mortise/solid/loads.hpp"
#include "mortise/solid/nodal_mass.hpp"
#include "mortise/solid/prescribed_motion.hpp"

namespace mortise {

/// A contribution that counts its evaluations.
class CountedContribution : public Contribution {
 public:
  CountedContribution(std::string name, Timers timers) : name_(std::move(name)), timers_(std::move(timers)) {}
  std::string name() const final { return name_; }
  long calls() const { return calls_; }

 protected:
  Timers::Scope count(const char* timer) {
    ++calls_;
    return timers_.scope(timer);
  }

 private:
  std::string name_;
  Timers timers_;
  long calls_ = 0;
};

/// f_int of all bodies, and the heat of those that heat: power over the step from the last committed state.
class BulkContribution final : public CountedContribution {
 public:
  /// @param share_at_start  of the power at the start of a step in what is in balance over it; none: time is none, so that there are no powers
  BulkContribution(std::shared_ptr<Bodies> bodies, std::optional<double> share_at_start, const Timers& timers);
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override;
  bool depends_on_time() const override { return heats(); }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;
  void add_residual_and_jacobian(const Configuration& at, const JacobianWeights& weights, Vector& residual, Matrix& jacobian,
                                 std::optional<StepFailure>& failure) override;
  void commit(const Configuration& at) override;
  void serialize(StateArchive& archive) override;

  /// The state from which the first step starts.
  void begin(const Configuration& at) { bodies_->begin(at.local_unknowns); }

  /// Mean power of the last step that became heat [mesh bodies]; empty: bodies do not heat.
  const std::vector<double>& heat_power() const { return power_; }
  /// Since the start.
  const std::vector<double>& heat_energy() const { return energy_; }

 private:
  bool heats() const { return share_at_start_ && bodies_->heat(); }
  /// Length of the step that ends at `at`.
  double time_step(const Configuration& at) const;

  std::shared_ptr<Bodies> bodies_;
  std::optional<double> share_at_start_;
  double time_ = 0.0;  ///< of the last committed state
  std::vector<double> power_, energy_, power_at_end_;
};

/// - f_ext of one load.
class LoadContribution final : public CountedContribution {
 public:
  LoadContribution(std::string name, std::unique_ptr<Load> load, const Timers& timers);
  /// Weight is then that of a scene's mass: rigid bodies have it too, and nodes without mass have none.
  void weigh_by(std::shared_ptr<const NodalMass> mass) { mass_ = std::move(mass); }
  Kind kind() const override { return Kind::external; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

 private:
  std::unique_ptr<Load> load_;
  std::shared_ptr<const NodalMass> mass_;  ///< null: the scene has no inertia
};

/// Rigid bodies, and kinematic couplings of sets to reference points.
class FollowingNodes final : public RigidConstraints {
 public:
  /// `prescribed`: owned dofs, ascending.
  FollowingNodes(const Bodies& bodies, const std::vector<LocalOrdinal>& prescribed) : followers_(bodies), full_turns_(bodies, prescribed) {}
  const std::vector<LocalOrdinal>& dofs() const override { return followers_.dofs(); }
  const std::vector<LocalOrdinal>& followed() const override { return followers_.followed(); }
  std::vector<Dependence> evaluate(const Vector& local_displacement) const override { return followers_.evaluate(local_displacement); }
  void check(const Vector& local_displacement, std::optional<StepFailure>& failure) const override { full_turns_.check(local_displacement, failure); }

 private:
  Followers followers_;
  FullTurns full_turns_;
};

}  // namespace mortise
