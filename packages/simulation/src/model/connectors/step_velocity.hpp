#pragma once
// Velocity in statics, over the steps.

#include "mortise/core/state_archive.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/solid/bodies.hpp"

namespace mortise {

/// (d - d_n) / (t - t_n), d_n the displacement at the time t_n of the last accepted step. Between two steps, at t_n, it is that of the last one.
/// Vectors on owned dofs, then ghosts.
class StepVelocity {
 public:
  explicit StepVelocity(std::shared_ptr<const Bodies> bodies);

  RCP<const Vector> at(const Configuration& at) const;
  /// 1 / (t - t_n); 0 between two steps.
  double per_time(const Configuration& at) const;
  /// The step that ended at `at` is accepted, with a velocity.
  void accept(const Configuration& at, const Vector& velocity);
  /// Of the last accepted step.
  const Vector& last() const { return *last_; }
  /// Change of the displacement over the step that ends at `at`, on owned dofs and ghosts.
  RCP<Vector> change(const Configuration& at) const;
  /// Stores or restores them, with names that begin with `name`. Collective.
  void serialize(StateArchive& archive, const std::string& name);

 private:
  std::shared_ptr<const Bodies> bodies_;
  double time_ = 0.0;                ///< t_n
  RCP<Vector> displacement_, last_;  ///< d_n
};

}  // namespace mortise
