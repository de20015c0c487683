#include "model/connectors/connector_contributions.hpp"

#include <Tpetra_Vector.hpp>

namespace mortise {

void SpringForces::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = count("springs");
  springs_->add_forces(at.local_unknowns, nullptr, residual, failure);
}

void SpringForces::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) {
  const auto timer = count("springs");
  springs_->add_derivatives(at.local_unknowns, nullptr, weights.unknowns, 0.0, nullptr, jacobian);
}

DashpotForces::DashpotForces(std::shared_ptr<const Connectors> dashpots, bool is_static, const Timers& timers)
    : CountedContribution("dashpots", timers), dashpots_(std::move(dashpots)), is_static_(is_static), memory_(dashpots_->bodies()) {}

FieldUse DashpotForces::uses() const {
  FieldUse uses;
  uses.time_derivatives = is_static_ ? 0 : 1;
  return uses;
}

void DashpotForces::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = count("dashpots");
  if (is_static_)
    dashpots_->add_forces(at.local_unknowns, memory_.at(at).get(), residual, failure);
  else
    dashpots_->add_forces(at.local_unknowns, at.local_velocity, residual, failure);
}

void DashpotForces::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) {
  const auto timer = count("dashpots");
  if (is_static_)
    dashpots_->add_derivatives(at.local_unknowns, memory_.at(at).get(), weights.unknowns, weights.unknowns * memory_.per_time(at), nullptr, jacobian);
  else if (weights.unknowns != 0.0 || weights.velocity != 0.0)
    dashpots_->add_derivatives(at.local_unknowns, at.local_velocity, weights.unknowns, weights.velocity, weights.local_velocity_shares, jacobian);
}

void DashpotForces::commit(const Configuration& at) { memory_.accept(at, is_static_ ? *memory_.at(at) : *at.local_velocity); }

}  // namespace mortise
