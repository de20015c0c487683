#include "mortise/nonlinear/semi_smooth_system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "system/initial_motion.hpp"
#include "system/system_model.hpp"

namespace mortise {

SemiSmoothSystem::SemiSmoothSystem(SystemParts parts, Timers timers)
    : model_(std::make_shared<const detail::SystemModel>(std::move(parts), std::move(timers))) {}

const SystemParts& SemiSmoothSystem::parts() const { return model_->parts(); }
const RCP<const Map>& SemiSmoothSystem::map() const { return model_->map(); }
RCP<const Vector> SemiSmoothSystem::unknowns(const Vector& x) const { return model_->d(x); }
RCP<Vector> SemiSmoothSystem::unknowns(Vector& x) const { return model_->d(x); }
RCP<const Vector> SemiSmoothSystem::multipliers(const Vector& x) const { return model_->z(x); }
RCP<Vector> SemiSmoothSystem::multipliers(Vector& x) const { return model_->z(x); }
double SemiSmoothSystem::stiffness_scale(std::size_t field) const { return model_->stiffness_scale(field); }

RCP<const Vector> SemiSmoothSystem::first_field(const Vector& of_dofs) const {
  if (model_->sizes().fields() == 1) return rcp(&of_dofs, false);
  const auto part = rcp(new Vector(of_dofs, Teuchos::Copy));
  const auto view = part->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t row = 0; row < view.extent(0); ++row)
    if (model_->sizes().field(static_cast<LocalOrdinal>(row)) != 0) view(row, 0) = 0.0;
  return part;
}

double SemiSmoothSystem::largest_unknown(const Vector& x) const { return model_->sizes().largest(*unknowns(x)); }

AcceptedState SemiSmoothSystem::initial_state(const Vector& x, double time) const {
  AcceptedState state{rcp(new Vector(x, Teuchos::Copy)), {time, std::nullopt, {}, nullptr, std::nullopt}, {}, std::nullopt};
  if (!parts().contact) return state;
  state.context.contact = parts().contact->initial_history(*unknowns(x));
  state.context.states = (*state.context.contact)->states;
  return state;
}

AcceptedState SemiSmoothSystem::initial_state(const Vector& x, const Vector& velocity, bool at_rest, double time) const {
  if (!parts().time) throw std::logic_error("SemiSmoothSystem: rates of a system without time derivatives");
  AcceptedState state = initial_state(x, time);
  detail::begin_motion(*model_, velocity, at_rest, state);
  return state;
}

namespace {

/// Null in a system without time derivatives.
std::shared_ptr<const TimeStep> time_step(const detail::SystemModel& model, const AcceptedState& state, double time) {
  const auto& integration = model.parts().time;
  if (!integration) return nullptr;
  if (!state.rates) throw std::logic_error("SemiSmoothSystem: a state without rates in a system with time derivatives");
  return std::make_shared<const TimeStep>(TimeStep{integration.get(), time - state.context.time, model.d(*state.x), *state.rates,
                                                   integration->scheme.blends_forces() ? state.internal_forces : Teuchos::null});
}

}  // namespace

StepContext SemiSmoothSystem::step_from(const AcceptedState& state, double time) const {
  StepContext context = state.context;
  context.time = time;
  context.step = time_step(*model_, state, time);
  return context;
}

StepContext SemiSmoothSystem::start_step(const AcceptedState& state, double time, const Vector& d, Vector& z) const {
  if (!parts().contact) return step_from(state, time);
  const ContactHistory history = parts().contact->start_step(*state.context.contact, d, z);
  return {time, history, history->states, time_step(*model_, state, time), std::nullopt};
}

StepContext SemiSmoothSystem::weigh_gaps(StepContext context, double share) const {
  if (parts().contact) context.contact = parts().contact->weigh_gaps(*context.contact, share);
  return context;
}

SystemEvaluation SemiSmoothSystem::evaluate(const Vector& x, const StepContext& context, StiffnessIs stiffness) const {
  return SystemEvaluation(model_->evaluate(x, context, {}, stiffness));
}

SystemEvaluation SemiSmoothSystem::evaluate_at(const AcceptedState& state, const Vector& z, const StepContext& context) const {
  Vector x(*state.x, Teuchos::Copy);
  Tpetra::deep_copy(*multipliers(x), z);
  return SystemEvaluation(model_->evaluate(x, context, {model_->depends_on_time() ? Teuchos::null : state.internal_forces, std::nullopt}));
}

SystemEvaluation SemiSmoothSystem::with_multipliers(const SystemEvaluation& evaluation, const Vector& z) const {
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation);
  Vector x(at.x, Teuchos::Copy);
  Tpetra::deep_copy(*multipliers(x), z);
  return SystemEvaluation(model_->evaluate(x, at.context, {at.internal, at.contact}));
}

SystemEvaluation SemiSmoothSystem::solving_for(const SystemEvaluation& evaluation, std::optional<std::size_t> field) const {
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation);
  StepContext context = at.context;
  context.field = field;
  return SystemEvaluation(model_->evaluate(at.x, context, {at.internal, at.contact}));
}

double SemiSmoothSystem::prescribed_deviation(const Vector& x, double time) const {
  double mine = 0.0, largest = 0.0;
  std::optional<StepFailure> failure;  // evaluate() says it
  if (!parts().constraints) return 0.0;
  const AffineConstraints& constraints = *parts().constraints;
  if (const RCP<Vector> deviation = constraints.offset(time, failure); !deviation.is_null()) {
    const RCP<const Vector> d = unknowns(x);
    constraints.T()->apply(*d, *deviation, Teuchos::NO_TRANS, 1.0, 1.0);
    deviation->update(-1.0, *d, 1.0);
    const auto view = deviation->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal dof : constraints.dependent()) mine = std::max(mine, std::abs(view(dof, 0)) / parts().length);
  }
  const std::vector<double> values = constraints.prescribed_values(time, failure);
  const std::vector<LocalOrdinal>& rows = constraints.prescribed();
  const detail::FieldSizes& sizes = model_->sizes();
  const RCP<const Vector> d = unknowns(x);
  const auto values_of = d->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < rows.size(); ++i) mine = std::max(mine, std::abs(values_of(rows[i], 0) - values[i]) / sizes.size(sizes.field(rows[i])));
  Teuchos::reduceAll(model_->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  return largest;
}

Drive SemiSmoothSystem::drive(const Vector& x, double from, double to) const { return {model_, x, from, to}; }

std::optional<SystemEvaluation> SemiSmoothSystem::follow_cover(const SystemEvaluation& evaluation) const {
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation);
  if (!at.contact) return std::nullopt;
  Vector z(*at.z, Teuchos::Copy);
  if (!at.contact->follow_cover(at.context.states, z)) return std::nullopt;
  return with_multipliers(evaluation, z);
}

SystemLinearisation SemiSmoothSystem::linearise(const SystemEvaluation& evaluation) const {
  model_->stiffness(evaluation.evaluated_);
  return {model_, evaluation};
}

std::optional<SystemEvaluation> SemiSmoothSystem::augment(const SystemEvaluation& evaluation, int round) const {
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation);
  if (!at.contact) return std::nullopt;
  const Augmentation result = parts().contact->augment(*at.laws, round);
  if (result.exhausted)
    throw StepFailure(
        FailureKind::augmentation,
        fmt::format("contact \"{}\": after {} updates of the multipliers, one more would change them by {:.2e} of the largest one, {}; allowed "
                    "is an error of {:.0e}; please allow more \"augmentations\", or take smaller steps",
                    result.pair, round - 1, result.change,
                    std::isfinite(result.error) ? fmt::format("and they are wrong by about {:.2e} of it", result.error)
                                                : std::string("and they have not fallen once"),
                    result.tolerance));
  if (!result.more) return std::nullopt;
  StepContext context = at.context;
  context.contact = result.history;
  return SystemEvaluation(model_->evaluate(at.x, context, {at.internal, at.contact->with(*result.history)}));
}

AcceptedState SemiSmoothSystem::commit(const SystemEvaluation& evaluation) const {
  const detail::EvaluatedSystem& at = detail::evaluated(evaluation);
  const TimeStep* step = at.context.step.get();
  const Configuration configuration = model_->configuration(at.context.time, *at.d, step);
  for (const auto& contribution : parts().contributions) contribution->commit(configuration);
  for (const auto& contribution : parts().contact_contributions) contribution->commit(*at.laws, configuration);
  model_->forget_stiffness();
  AcceptedState state{rcp(new Vector(at.x, Teuchos::Copy)), at.context, at.internal, std::nullopt};
  if (step != nullptr) state.rates = rates_at_end(*step, *at.d, at.external);
  state.context.step = nullptr;  // it holds the state before
  if (!at.contact) return state;
  state.context.contact = parts().contact->commit(*at.laws);
  state.context.states = (*state.context.contact)->states;
  return state;
}

namespace {

/// Stores or restores a state beside contact. `internal` is null where forces are not known.
void serialize_state(StateArchive& archive, Vector& x, double& time, const RCP<Vector>& internal) {
  serialize(archive, "time", time);
  serialize(archive, "x", "unknowns", x);
  if (!internal.is_null()) serialize(archive, "internal_forces", "dofs", *internal);
}

}  // namespace

namespace {

/// What a state holds of rates; the vectors that a scheme has are stored or restored.
void serialize_rates(StateArchive& archive, const TimeScheme& scheme, const RCP<const Map>& dofs, AcceptedRates& rates) {
  const auto vector = [&](const char* name, RCP<const Vector>& value) {
    const auto copy = archive.restores() ? rcp(new Vector(dofs)) : rcp(new Vector(*value, Teuchos::Copy));
    serialize(archive, name, "dofs", *copy);
    value = copy;
  };
  vector("velocity", rates.velocity);
  vector("acceleration", rates.acceleration);
  if (scheme.has_balanced_acceleration()) vector("balanced_acceleration", rates.balanced_acceleration);
  if (scheme.blends_forces()) vector("external_forces", rates.external_forces);
}

}  // namespace

void SemiSmoothSystem::store(StateArchive& archive, const AcceptedState& state) const {
  Vector x(*state.x, Teuchos::Copy);
  double time = state.context.time, has_forces = state.internal_forces.is_null() ? 0.0 : 1.0;
  serialize(archive, "has_internal_forces", has_forces);
  serialize_state(archive, x, time, has_forces > 0.0 ? rcp(new Vector(*state.internal_forces, Teuchos::Copy)) : Teuchos::null);
  if (parts().time) {
    AcceptedRates rates = *state.rates;
    serialize_rates(archive, parts().time->scheme, parts().dofs, rates);
  }
  model_->serialize(archive);
  if (state.context.contact) parts().contact->store(archive, *state.context.contact);
}

AcceptedState SemiSmoothSystem::restore(StateArchive& archive) const {
  const auto x = rcp(new Vector(map()));
  double time = 0.0, has_forces = 0.0;
  serialize(archive, "has_internal_forces", has_forces);
  const RCP<Vector> internal = has_forces > 0.0 ? rcp(new Vector(parts().dofs)) : Teuchos::null;
  serialize_state(archive, *x, time, internal);
  AcceptedState state{x, {time, std::nullopt, {}, nullptr, std::nullopt}, internal, std::nullopt};
  if (parts().time) serialize_rates(archive, parts().time->scheme, parts().dofs, state.rates.emplace());
  model_->serialize(archive);
  if (!parts().contact) return state;
  state.context.contact = parts().contact->restore(archive, *unknowns(std::as_const(*x)), *multipliers(std::as_const(*x)));
  state.context.states = (*state.context.contact)->states;
  return state;
}

}  // namespace mortise
