#include "mortise/simulation/run/output/step_evaluation.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <limits>

#include "model/connectors/connector_contributions.hpp"
#include "model/connectors/stabilisation.hpp"
#include "model/edge_contact.hpp"
#include "model/heat/heat_of_step.hpp"
#include "run/output/step_motion.hpp"

namespace mortise {

StepEvaluation::StepEvaluation(const Scene& scene, const Model& model, const SemiSmoothSystem& system)
    : scene_(scene), model_(model), system_(system), evaluators_(make_evaluators(scene, model)) {}

std::vector<std::string> StepEvaluation::names() const {
  std::vector<std::string> names;
  for (const auto& quantity : scene_.quantities) names.push_back(quantity.name);
  return names;
}

RCP<Vector> StepEvaluation::local(const Vector& displacement) const {
  const auto values = rcp(new Vector(model_.bodies()->space().local_dofs()));
  values->doImport(displacement, *model_.bodies()->space().ghost_import(), Tpetra::INSERT);
  return values;
}

// A force is a stiffness times a position, and that is known to eps (L + |u|): summed over all dofs, of which the stiffness scale is the mean
// diagonal.
double StepEvaluation::force_round_off(const Vector& displacement) const {
  const double sum_of_diagonal = system_.stiffness_scale() * static_cast<double>(model_.dofs());
  return std::numeric_limits<double>::epsilon() * sum_of_diagonal * (model_.size().length + system_.first_field(displacement)->normInf());
}

RCP<Vector> StepEvaluation::spring_force(const SystemEvaluation& at) const {
  const Connectors* springs = model_.connectors().springs.get();
  if (springs == nullptr) return Teuchos::null;
  const auto force = rcp(new Vector(model_.space().dofs()));
  std::optional<StepFailure> failure;  // converged states have none
  springs->add_forces(*local(*system_.unknowns(at.x())), nullptr, *force, failure);
  if (const TimeStep* step = at.context().step.get(); step != nullptr && step->integration->scheme.blends_forces()) {
    Vector before(model_.space().dofs());
    springs->add_forces(*local(*step->unknowns), nullptr, before, failure);
    force->update(step->integration->scheme.alpha_f, before, step->integration->scheme.force_share());
  }
  return force;
}

std::vector<double> StepEvaluation::quantities(const SystemEvaluation& at) {
  if (scene_.quantities.empty()) return {};
  const auto displacement = system_.unknowns(at.x());
  const auto local_displacement = local(*displacement);
  const double time = at.context().time;
  const RCP<const Vector> all_forces = at.forces(), reaction = system_.first_field(*all_forces);
  const RCP<const Vector> all_external = external_force(at.x(), time);
  const auto external = rcp(new Vector(*system_.first_field(*all_external), Teuchos::Copy));
  std::optional<StepMotion> motion = step_motion(model_, system_, at);
  if (motion && !has_begun_ && !motion->is_over_step) add_forces_at_start(model_, at, *motion);
  has_begun_ = true;
  if (const TimeStep* step = at.context().step.get(); step != nullptr && step->integration->scheme.blends_forces()) {
    const double before = step->integration->scheme.alpha_f;
    external->update(-before, *step->start.external_forces, 1.0 - before);
  }

  QuantityContext context = quantity_context(scene_, model_);
  context.time = time;
  context.displacement = displacement.get();
  context.local_displacement = local_displacement.get();
  context.laws = contact_laws(at);
  if (const EdgeContact* edges = model_.edges())
    context.edge_force = [edges, local_displacement](std::size_t pair) { return edges->resultant(pair, *local_displacement); };
  const RCP<const Vector> springs = spring_force(at);
  context.connectors.spring_force = springs.get();
  if (model_.connectors().dashpot_forces) context.connectors.dashpot_velocity = &model_.connectors().dashpot_forces->last_velocity();
  if (model_.connectors().stabilisation) context.connectors.stabilisation_force = &model_.connectors().stabilisation->force();
  context.reaction = reaction.get();
  if (model_.heat().bodies) context.heat = heat_of_step(scene_, model_, system_, at, *all_forces, time - last_time_);
  last_time_ = time;
  context.external_force = external.get();
  const std::optional<MotionOfStep> of_step = motion ? std::optional(motion->of_quantities()) : std::nullopt;
  context.motion = of_step ? &*of_step : nullptr;
  context.force_round_off = force_round_off(*displacement);
  for (const auto& evaluator : evaluators_) context.earlier_values.push_back(evaluator->evaluate(context));
  return context.earlier_values;
}

RCP<Vector> StepEvaluation::external_force(const Vector& x, double time) const {
  const auto displacement = system_.unknowns(x);
  const auto local_displacement = local(*displacement);
  const auto external = rcp(new Vector(model_.bodies()->space().dofs()));
  std::optional<StepFailure> failure;
  const Configuration configuration{time, *displacement, *local_displacement};
  for (const auto& contribution : model_.parts().contributions)
    if (contribution->kind() == Contribution::Kind::external) contribution->add_residual(configuration, *external, failure);
  throw_if_any(*model_.mesh()->comm, failure);
  external->scale(-1.0);
  return external;
}

void StepEvaluation::serialize(StateArchive& archive) {
  mortise::serialize(archive, "quantities.last_time", last_time_);
  for (std::size_t n = 0; n < evaluators_.size(); ++n) evaluators_[n]->serialize(archive, "quantity." + scene_.quantities[n].name);
}

std::vector<Field> StepEvaluation::fields(const SystemEvaluation& at, const std::vector<std::string>& names) {
  const auto displacement = system_.unknowns(at.x());
  const auto local_displacement = local(*displacement);
  std::vector<Field> fields;
  const RCP<const Vector> forces = at.forces();
  Vector reaction(forces->getMap());
  {
    const auto all = forces->getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto supports = reaction.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t dof = 0; dof < supports.extent(0); ++dof) supports(dof, 0) = 0.0;
    for (const LocalOrdinal dof : model_.supports().dofs) supports(dof, 0) = all(dof, 0);
  }
  FieldState state{*model_.bodies(), model_.contact().get(), *displacement, *local_displacement, contact_laws(at), &reaction};
  const HeatOfStep heat = heat_of_step(scene_, model_);
  state.heat = &heat;
  const std::optional<StepMotion> motion = step_motion(model_, system_, at);
  if (motion) {
    state.velocity = motion->velocity.get();
    state.acceleration = motion->acceleration.get();
  }
  for (const auto& name : names) fields.push_back(make_field(name, state));
  return fields;
}

std::vector<std::vector<ProfilePoint>> StepEvaluation::profiles(const SystemEvaluation& at) {
  std::vector<std::vector<ProfilePoint>> profiles;
  if (!model_.contact()) return profiles;
  const auto pairs = quantity_context(scene_, model_).pairs;
  for (std::size_t pair = profiles_.size(); pair < pairs.size(); ++pair) profiles_.emplace_back(*model_.mesh(), pairs[pair], pair);
  const auto displacement = system_.unknowns(at.x());
  const auto local_displacement = local(*displacement);
  const FieldState state{*model_.bodies(), model_.contact().get(), *displacement, *local_displacement, contact_laws(at)};
  for (const ContactProfile& profile : profiles_) profiles.push_back(profile.points(state));
  return profiles;
}

const ContactLaws* StepEvaluation::contact_laws(const SystemEvaluation& at) const { return model_.contact() ? &at.contact_laws() : nullptr; }

}  // namespace mortise
