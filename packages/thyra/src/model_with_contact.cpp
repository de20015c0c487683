// Steps of a model with contact: their start, updates of multipliers, acceptance and storage.

#include "mortise/thyra/model_with_contact.hpp"

#include <Tpetra_Vector.hpp>
#include <stdexcept>

#include "condensed_model.hpp"
#include "product_model.hpp"
#include "step_memory.hpp"
#include "tpetra_of_thyra.hpp"

namespace mortise {

ModelWithContact::ModelWithContact(const RCP<ThyraModel>& model, std::shared_ptr<detail::StepMemory> memory)
    : ::Thyra::ModelEvaluatorDelegatorBase<Scalar>(model), memory_(std::move(memory)) {}

ModelWithContact::~ModelWithContact() = default;

void ModelWithContact::start(const Vector& d, std::optional<double> time) {
  detail::StepMemory& memory = *memory_;
  const auto z = rcp(new Vector(*memory.accepted_multipliers, Teuchos::Copy));
  if (time) memory.time = *time;
  const ContactHistory from = memory.contact.with_clearances(memory.accepted, memory.time);
  memory.history = memory.contact.start_step(from, memory.displacement(d, memory.of_nodes), *z);
  memory.multipliers = z;
  memory.updates = 0;
  begin();
}

void ModelWithContact::start_step(const ThyraVector& x, std::optional<double> time) { start(*displacements_of(x), time); }

ContactLaws ModelWithContact::laws_at(const ThyraVector& x) const {
  const RCP<const Vector> d = displacements_of(x), z = multipliers_of(x);  // the second one may evaluate
  return memory_->laws(memory_->contact.evaluate(memory_->displacement(*d, memory_->of_nodes), memory_->history), *z);
}

ContactHeat ModelWithContact::heat_at(const ContactLaws& laws, const ThyraVector& x) const {
  return memory_->heat->evaluate(laws, *displacements_of(x), memory_->of_heat);
}

ContactHeat ModelWithContact::heat(const ThyraVector& x) const {
  if (!memory_->heat) throw std::logic_error("contact: heat() of a model without WithContactOptions::heat");
  return heat_at(laws_at(x), x);
}

bool ModelWithContact::update_multipliers(const ThyraVector& x) {
  detail::StepMemory& memory = *memory_;
  const ContactLaws laws = laws_at(x);
  const Augmentation update = memory.contact.augment(laws, memory.updates + 1);
  if (update.exhausted)
    throw StepFailure(FailureKind::augmentation, "contact: multipliers of pair \"" + update.pair + "\" are not exact to their tolerance after " +
                                                     std::to_string(memory.updates) + " updates");
  if (!update.more) return false;
  ++memory.updates;
  memory.history = *update.history;
  memory.multipliers = rcp(new Vector(laws.multipliers(), Teuchos::Copy));
  begin();
  return true;
}

void ModelWithContact::accept_step(const ThyraVector& x) {
  detail::StepMemory& memory = *memory_;
  const ContactLaws laws = laws_at(x);
  std::optional<ContactHeat> heat;
  if (memory.heat) heat = heat_at(laws, x);
  memory.accepted = memory.contact.commit(laws);
  memory.accepted_multipliers = rcp(new Vector(laws.multipliers(), Teuchos::Copy));
  memory.accepted_laws = laws;
  memory.accepted_heat = heat;
  start(*displacements_of(x), std::nullopt);
}

const ContactSystem& ModelWithContact::contact() const { return memory_->contact; }
RCP<const Vector> ModelWithContact::multipliers(const ThyraVector& x) const { return multipliers_of(x); }
const std::optional<ContactLaws>& ModelWithContact::accepted_laws() const { return memory_->accepted_laws; }
const std::optional<ContactHeat>& ModelWithContact::accepted_heat() const { return memory_->accepted_heat; }
const std::optional<StepFailure>& ModelWithContact::failure() const { return memory_->failure; }
const ContactHistory& ModelWithContact::history() const { return memory_->accepted; }
const Vector& ModelWithContact::accepted_multipliers() const { return *memory_->accepted_multipliers; }

void ModelWithContact::resume(const ContactHistory& history, const Vector& multipliers, const ThyraVector& x) {
  detail::StepMemory& memory = *memory_;
  if (!multipliers.getMap()->isSameAs(*memory.contact.multiplier_map()))
    throw std::invalid_argument("contact: resume() with multipliers on another map; the slave surfaces have to be those that the history is of");
  memory.accepted = history;
  memory.accepted_multipliers = rcp(new Vector(multipliers, Teuchos::Copy));
  memory.accepted_laws.reset();
  memory.accepted_heat.reset();
  start(*displacements_of(x), std::nullopt);
}

void ModelWithContact::store(StateArchive& archive) const {
  Vector z(*memory_->accepted_multipliers, Teuchos::Copy);
  serialize(archive, "contact.multipliers", "multipliers", z);
  memory_->contact.store(archive, memory_->accepted);
}

void ModelWithContact::restore(StateArchive& archive, const ThyraVector& x) {
  Vector z(memory_->contact.multiplier_map());
  serialize(archive, "contact.multipliers", "multipliers", z);
  const RCP<const Vector> d = displacements_of(x);
  resume(memory_->contact.restore(archive, memory_->displacement(*d, memory_->of_nodes), z), z, x);
}

RCP<ModelWithContact> with_contact(const RCP<ThyraModel>& model, const HostDisplacements& displacements, std::vector<ContactPair> pairs,
                                   const WithContactOptions& options) {
  if (model.is_null()) throw std::invalid_argument("contact: with_contact() of a null model");
  if (Teuchos::rcp_dynamic_cast<ModelWithContact>(model) != Teuchos::null)
    throw std::invalid_argument("contact: with_contact() of a model that has contact already; give all pairs at once");
  const auto space = Teuchos::rcp_dynamic_cast<const ::Thyra::TpetraVectorSpace<Scalar, LocalOrdinal, GlobalOrdinal, NodeType>>(model->get_x_space());
  if (space.is_null()) throw std::invalid_argument("contact: x_space of the model is no Thyra::TpetraVectorSpace");
  const RCP<const ThyraSolverFactory> solver = options.linear_solver.is_null() ? model->get_W_factory() : options.linear_solver;
  if (solver.is_null())
    throw std::invalid_argument(
        "contact: the model has no get_W_factory(); give one, or WithContactOptions::linear_solver. A solver that is set on the decorated model does "
        "not know how multipliers follow");
  const ThyraInArgs nominal = model->getNominalValues();
  const RCP<const ThyraVector> x = nominal.get_x();
  const Vector d = x.is_null() ? Vector(space->getTpetraMap()) : Vector(*detail::tpetra(*x), Teuchos::Copy);
  const auto memory = std::make_shared<detail::StepMemory>(displacements, space->getTpetraMap(), std::move(pairs), options, nominal, d);
  RCP<ModelWithContact> result;
  if (options.unknowns == ContactUnknowns::displacements)
    result = detail::condensed_model(model, memory, solver);
  else
    result = detail::product_model(model, memory, solver);
  result->start(d, std::nullopt);
  return result;
}

}  // namespace mortise
