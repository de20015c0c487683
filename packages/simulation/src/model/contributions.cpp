#include "model/contributions.hpp"

#include <Tpetra_Vector.hpp>

namespace mortise {

BulkContribution::BulkContribution(std::shared_ptr<Bodies> bodies, std::optional<double> share_at_start, const Timers& timers)
    : CountedContribution("bulk", timers), bodies_(std::move(bodies)), share_at_start_(share_at_start) {
  if (heats()) power_.assign(bodies_->mesh()->bodies.size(), 0.0);
  energy_ = power_at_end_ = power_;
}

FieldUse BulkContribution::uses() const {
  FieldUse use;
  if (bodies_->know_temperature()) use.reads.emplace_back("temperature");
  if (heats()) use.writes.emplace_back("temperature");
  return use;
}

double BulkContribution::time_step(const Configuration& at) const { return heats() && at.time > time_ ? at.time - time_ : Bodies::without_rates; }

void BulkContribution::commit(const Configuration& at) {
  if (heats()) {
    const std::vector<double> now = bodies_->heat_powers(at.local_unknowns, time_step(at));
    for (std::size_t body = 0; body < now.size(); ++body) {
      power_[body] = (1.0 - *share_at_start_) * now[body] + *share_at_start_ * power_at_end_[body];
      energy_[body] += (at.time - time_) * power_[body];
    }
    power_at_end_ = now;
  }
  time_ = at.time;
  bodies_->commit(at.local_unknowns);
}

void BulkContribution::serialize(StateArchive& archive) {
  bodies_->serialize(archive);
  if (!heats()) return;
  mortise::serialize(archive, "bulk.time", time_);
  mortise::serialize(archive, "bulk.heat_power", power_);
  mortise::serialize(archive, "bulk.heat_power_at_end", power_at_end_);
  mortise::serialize(archive, "bulk.heat_energy", energy_);
}

void BulkContribution::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = count("bulk");
  bodies_->add_internal_force(at.local_unknowns, residual, failure, time_step(at));
}

void BulkContribution::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  const auto timer = count("bulk");
  bodies_->add_stiffness(at.local_unknowns, jacobian, failure, weights.unknowns, time_step(at));
}

void BulkContribution::add_residual_and_jacobian(const Configuration& at, const JacobianWeights& weights, Vector& residual, Matrix& jacobian,
                                                 std::optional<StepFailure>& failure) {
  const auto timer = count("bulk");
  bodies_->add_internal_force_and_stiffness(at.local_unknowns, residual, jacobian, failure, weights.unknowns, time_step(at));
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
