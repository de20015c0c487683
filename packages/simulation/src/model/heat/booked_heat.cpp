#include "model/heat/booked_heat.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/core/over_ranks.hpp"
#include "mortise/thermal/heat_contributions.hpp"

namespace mortise {

BookedHeat::BookedHeat(std::string name, std::shared_ptr<Contribution> flow, std::shared_ptr<const ThermalBodies> bodies,
                       const FlowsAtStart& at_start, const Timers& timers)
    : CountedContribution(std::move(name), timers),
      flow_(std::move(flow)),
      bodies_(std::move(bodies)),
      at_start_(at_start),
      power_(bodies_->mesh()->bodies.size(), 0.0),
      energy_(power_) {
  if (at_start_.share > 0.0) before_ = rcp(new Vector(bodies_->space().dofs()));
}

// What depends on the start of a step is evaluated again in each.
Contribution::Kind BookedHeat::kind() const { return at_start_.is_of_system ? flow_->kind() : Kind::interaction; }

void BookedHeat::add_flow(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  flow_->add_residual(at, residual, failure);
}

RCP<Vector> BookedHeat::flow_at(const Configuration& at, std::optional<StepFailure>& failure) {
  const auto flow = rcp(new Vector(bodies_->space().dofs()));
  add_flow(at, *flow, failure);
  return flow;
}

void BookedHeat::add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const auto timer = count("heat");
  if (at_start_.is_of_system) {
    add_flow(at, residual, failure);
    return;
  }
  residual.update(1.0 - at_start_.share, *flow_at(at, failure), at_start_.share, *before_, 1.0);
}

void BookedHeat::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  const auto timer = count("heat");
  JacobianWeights own = weights;
  if (!at_start_.is_of_system) own.unknowns *= 1.0 - at_start_.share;
  flow_->add_jacobian(at, own, jacobian, failure);
}

void BookedHeat::begin(const Configuration& at) {
  time_ = at.time;
  if (before_.is_null()) return;
  std::optional<StepFailure> failure;
  before_ = flow_at(at, failure);
  throw_if_any(*bodies_->mesh()->comm, failure);
}

void BookedHeat::commit(const Configuration& at) {
  std::optional<StepFailure> failure;  // a converged state has none
  const RCP<Vector> now = flow_at(at, failure);
  power_ = sums(*now);
  if (!before_.is_null()) {
    const std::vector<double> before = sums(*before_);
    for (std::size_t body = 0; body < power_.size(); ++body) power_[body] = (1.0 - at_start_.share) * power_[body] + at_start_.share * before[body];
    before_ = now;
  }
  for (std::size_t body = 0; body < power_.size(); ++body) energy_[body] += (at.time - time_) * power_[body];
  time_ = at.time;
}

void BookedHeat::serialize(StateArchive& archive) {
  const std::string prefix = "heat." + name();
  mortise::serialize(archive, prefix + ".time", time_);
  mortise::serialize(archive, prefix + ".power", power_);
  mortise::serialize(archive, prefix + ".energy", energy_);
  if (!before_.is_null()) mortise::serialize(archive, prefix + ".before", "dofs", *before_);
}

std::vector<double> BookedHeat::sums(const Vector& flow) const {
  const Mesh& mesh = *bodies_->mesh();
  const FieldSpace& space = bodies_->space();
  const FieldRows& rows = space.rows(bodies_->temperature());
  std::vector<double> mine(mesh.bodies.size(), 0.0);
  const auto view = flow.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (rows.lives(node)) mine[static_cast<std::size_t>(mesh.body_of_node[static_cast<std::size_t>(node)])] += view(rows(node, 0), 0);
  return sum_over_ranks(*mesh.comm, mine);
}

StoredHeat::StoredHeat(const std::shared_ptr<const ThermalBodies>& bodies, const Timers& timers)
    : StoredHeat(bodies, std::make_shared<HeatCapacity>(bodies), timers) {}

StoredHeat::StoredHeat(const std::shared_ptr<const ThermalBodies>& bodies, std::shared_ptr<HeatCapacity> capacity, const Timers& timers)
    : BookedHeat("stored heat", capacity, bodies, {}, timers),
      capacity_(std::move(capacity)),
      last_(rcp(new Vector(bodies->space().local_dofs()))),
      last_rate_(rcp(new Vector(bodies->space().local_dofs()))) {}

RCP<const Vector> StoredHeat::rate(const Configuration& at) const {
  const double per_time = this->per_time(at);
  if (per_time == 0.0) return last_rate_;
  const auto result = rcp(new Vector(at.local_unknowns, Teuchos::Copy));
  result->update(-per_time, *last_, per_time);
  return result;
}

void StoredHeat::add_flow(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) {
  const RCP<const Vector> local = rate(at), owned = local->offsetView(bodies().space().dofs(), 0);
  Configuration with_rate{at.time, at.unknowns, at.local_unknowns};
  with_rate.velocity = owned.get();
  with_rate.local_velocity = local.get();
  capacity_->set_time_step(time_step(at));
  flow().add_residual(with_rate, residual, failure);
}

void StoredHeat::add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) {
  const auto timer = count("heat");
  const RCP<const Vector> local = rate(at), owned = local->offsetView(bodies().space().dofs(), 0);
  Configuration with_rate{at.time, at.unknowns, at.local_unknowns};
  with_rate.velocity = owned.get();
  with_rate.local_velocity = local.get();
  capacity_->set_time_step(time_step(at));
  flow().add_jacobian(with_rate, {0.0, per_time(at) * weights.unknowns, weights.unknowns, nullptr}, jacobian, failure);
}

void StoredHeat::begin(const Configuration& at) {
  BookedHeat::begin(at);
  last_->assign(at.local_unknowns);
}

void StoredHeat::commit(const Configuration& at) {
  const RCP<const Vector> rate = this->rate(at);
  const double step = time_step(at);
  BookedHeat::commit(at);
  last_rate_->assign(*rate);
  last_step_ = step;
  last_->assign(at.local_unknowns);
}

void StoredHeat::serialize_vector(StateArchive& archive, const std::string& name, Vector& local) const {
  Vector owned(*local.offsetView(bodies().space().dofs(), 0), Teuchos::Copy);
  mortise::serialize(archive, name, "dofs", owned);
  if (archive.restores()) local.doImport(owned, *bodies().space().ghost_import(), Tpetra::INSERT);
}

void StoredHeat::serialize(StateArchive& archive) {
  BookedHeat::serialize(archive);
  mortise::serialize(archive, "heat.last_step", last_step_);
  serialize_vector(archive, "heat.last", *last_);
  serialize_vector(archive, "heat.last_rate", *last_rate_);
}

}  // namespace mortise
