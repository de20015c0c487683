#include "model/contributions.hpp"

#include <Tpetra_Vector.hpp>

namespace mortise {

BulkContribution::BulkContribution(std::shared_ptr<Bodies> bodies, const Timers& timers)
    : CountedContribution("bulk", timers), bodies_(std::move(bodies)) {}

void BulkContribution::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = count("bulk");
  bodies_->add_internal_force(at.local_unknowns, residual, failure);
}

void BulkContribution::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  const auto timer = count("bulk");
  bodies_->add_stiffness(at.local_unknowns, jacobian, failure, weights.unknowns);
}

void BulkContribution::add_residual_and_jacobian(const Configuration& at, const JacobianWeights& weights, Vector& residual, Matrix& jacobian,
                                                 std::optional<StepFailure>& failure) {
  const auto timer = count("bulk");
  bodies_->add_internal_force_and_stiffness(at.local_unknowns, residual, jacobian, failure, weights.unknowns);
}

LoadContribution::LoadContribution(std::string name, std::unique_ptr<Load> load, const Timers& timers)
    : CountedContribution(std::move(name), timers), load_(std::move(load)) {}

void LoadContribution::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = count("loads");
  if (mass_ && load_->is_weight()) {
    Vector acceleration(residual.getMap());
    load_->add_acceleration(at.time, acceleration, failure);
    residual.update(-1.0, *mass_->times(acceleration), 1.0);
    return;
  }
  load_->add_residual(at.time, at.local_unknowns, residual, failure);
}

void LoadContribution::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  if (!load_->follows()) return;
  const auto timer = count("loads");
  load_->add_jacobian(at.time, at.local_unknowns, jacobian, failure, weights.unknowns);
}

}  // namespace mortise
