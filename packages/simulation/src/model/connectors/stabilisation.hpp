#pragma once
// Viscous stabilisation of bodies that nothing but contact holds.

#include <memory>
#include <vector>

#include "model/connectors/step_velocity.hpp"
#include "model/contributions.hpp"
#include "mortise/simulation/scene/stabilisation.hpp"

namespace mortise {

/// The force s(t) c_a v on node a, with the velocity v of StepVelocity and s = 1 - t/T, from T on 0. Of elements c_a is the integral of
/// factor E T / L^2 with Young's modulus E and the size L of the model, lumped. A rigid body has the modulus of the softest other body, and the
/// volume of a cube with the diagonal of the box around it, on the nodes of its surface alike. So a body that moves by x L in T feels stresses of
/// about factor x E, in any units and on any mesh, and at T nothing.
class Stabilisation final : public CountedContribution {
 public:
  /// @param stabilised  [mesh.bodies]
  Stabilisation(std::shared_ptr<const Bodies> bodies, const std::vector<char>& stabilised, const StabilisationOptions& options, double end_time,
                double length, const Timers& timers);

  /// It depends on time, and on what is committed.
  Kind kind() const override { return Kind::interaction; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;
  void commit(const Configuration& at) override;
  void serialize(StateArchive& archive) override;

  /// Of the last accepted step, on owned dofs, as the residual has it.
  const Vector& force() const { return *force_; }
  /// What it has taken in all accepted steps: sum f . (d - d_n).
  double work() const { return work_; }
  /// The largest norm of its forces in an accepted step.
  double largest_force() const { return largest_force_; }

 private:
  double share(double time) const { return time < until_ ? 1.0 - time / until_ : 0.0; }
  RCP<Vector> force_at(const Configuration& at) const;

  std::shared_ptr<const Bodies> bodies_;
  std::vector<double> viscosities_;  ///< [owned nodes]
  double until_;
  StepVelocity memory_;
  RCP<Vector> force_;
  double work_ = 0.0, largest_force_ = 0.0;
};

}  // namespace mortise
