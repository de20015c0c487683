#include "peer/peer_evaluation.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mortise/simulation/quantities/quantity_support.hpp"
#include "peer/calculix_deck.hpp"

namespace mortise {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool of_displacement(PointField field) {
  return field == PointField::displacement_x || field == PointField::displacement_y || field == PointField::displacement_z ||
         field == PointField::displacement_magnitude;
}

/// True if displacements, contact pressures, reactions and quantities before it are all that a quantity asks for.
bool can_be_had(const Quantity& quantity) {
  const auto is = [&](auto* kind) { return dynamic_cast<std::decay_t<decltype(kind)>>(&quantity) != nullptr; };
  if (const auto* field = dynamic_cast<const FieldQuantity*>(&quantity))
    return of_displacement(field->field) || field->field == PointField::contact_pressure;
  if (const auto* error = dynamic_cast<const ErrorNorm*>(&quantity)) return error->of != ErrorNorm::Of::stress;
  if (const auto* traction = dynamic_cast<const ContactTraction*>(&quantity)) return traction->part == ContactTraction::Part::pressure;
  const Reaction* reaction = dynamic_cast<const Reaction*>(&quantity);
  return (reaction != nullptr && reaction->component < Reaction::Of::rotation) || is((const PointDisplacement*)nullptr) ||
         is((const HalfWidth*)nullptr) || is((const ContactRadius*)nullptr) || is((const PeakPressure*)nullptr) ||
         is((const ContactLength*)nullptr) || is((const ContactArea*)nullptr) || is((const PressureVariation*)nullptr) ||
         is((const FormulaQuantity*)nullptr);
}

/// Sum of the values of a kind over the layers of a node.
std::array<double, 6> over_layers(const CalculixResults& results, const std::string& kind, const DeckNumbers& numbers, GlobalOrdinal node) {
  std::array<double, 6> sum{};
  const auto block = results.nodal.find(kind);
  if (block == results.nodal.end()) return sum;
  for (int layer = 0; layer < numbers.layers; ++layer)
    if (const auto values = block->second.find(numbers.node(node, layer)); values != block->second.end())
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += values->second[i];
  return sum;
}

}  // namespace

PeerEvaluation::PeerEvaluation(const Scene& scene, const Model& model, const CalculixResults& results) : scene_(scene), model_(model) {
  const auto& dofs = model.bodies()->space().dofs();
  for (auto* vector : {&displacement_, &nodal_force_, &external_, &reaction_}) *vector = rcp(new Vector(dofs));
  read_displacement(results);
  read_pressure(results);
  read_forces(results);
}

PeerEvaluation::~PeerEvaluation() = default;

void PeerEvaluation::read_displacement(const CalculixResults& results) {
  const Mesh& mesh = *model_.mesh();
  const DeckNumbers numbers(mesh);
  {
    const auto values = displacement_->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
      const auto sum = over_layers(results, "DISP", numbers, mesh.owned_nodes->getGlobalElement(node));
      for (int i = 0; i < numbers.dimension; ++i) values(numbers.dimension * node + i, 0) = sum[i] / numbers.layers;
    }
  }
  local_displacement_ = rcp(new Vector(model_.bodies()->space().local_dofs()));
  local_displacement_->doImport(*displacement_, *model_.bodies()->space().ghost_import(), Tpetra::INSERT);
}

/// z_j = p_j n_j.
void PeerEvaluation::read_pressure(const CalculixResults& results) {
  if (!model_.contact()) return;
  const Mesh& mesh = *model_.mesh();
  const DeckNumbers numbers(mesh);
  const ContactEvaluation evaluation = model_.contact()->evaluate(*displacement_, model_.contact()->initial_history(*displacement_));
  const auto& map = model_.contact()->multiplier_map();
  Vector multipliers(map);
  const ContactLaws without_pressure = evaluation.laws(multipliers);
  const auto values = multipliers.getLocalViewHost(Tpetra::Access::ReadWrite);
  const GlobalOrdinal first = model_.dofs();  // ids of multipliers follow those of displacements
  for (std::size_t pair = 0; pair < scene_.contact.size(); ++pair)
    for (const auto& state : node_states(without_pressure, pair)) {
      const LocalOrdinal multiplier = map->getLocalElement(first + numbers.dimension * state.node);
      if (multiplier < 0) continue;  // a node that is held carries none
      const double pressure = over_layers(results, "CONTACT", numbers, state.node)[3] / numbers.layers;
      for (int i = 0; i < numbers.dimension; ++i) values(multiplier + i, 0) = pressure * state.normal[i];
    }
  laws_ = evaluation.laws(multipliers);
}

void PeerEvaluation::read_forces(const CalculixResults& results) {
  const Mesh& mesh = *model_.mesh();
  const DeckNumbers numbers(mesh);
  for (const auto& options : scene_.loads) {
    std::optional<StepFailure> failure;
    options.value.load.options->make(model_.bodies())->add_residual(results.time, *local_displacement_, *external_, failure);
    throw_if_any(*mesh.comm, failure);
  }
  external_->scale(-1.0);
  const auto force = nodal_force_->getLocalViewHost(Tpetra::Access::ReadWrite), reaction = reaction_->getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto load = external_->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    const auto sum = over_layers(results, "FORC", numbers, mesh.owned_nodes->getGlobalElement(node));
    for (int i = 0; i < numbers.dimension; ++i) {
      const LocalOrdinal dof = numbers.dimension * node + i;
      force(dof, 0) = sum[i], reaction(dof, 0) = sum[i] - load(dof, 0);
    }
  }
}

QuantityContext PeerEvaluation::context() const {
  QuantityContext context = quantity_context(scene_, model_);
  context.time = scene_.stepping.end_time;
  context.displacement = displacement_.get();
  context.local_displacement = local_displacement_.get();
  context.laws = laws_ ? &*laws_ : nullptr;
  context.reaction = reaction_.get();
  context.external_force = external_.get();
  return context;
}

/// Balance of a body that no other pair touches: supports and loads on the master's body push the slave, those on the slave's are pushed by it.
double PeerEvaluation::contact_force(const ContactForce& quantity, const QuantityContext& context) const {
  if (quantity.part != ContactForce::Part::all) return none;
  const Mesh& mesh = *model_.mesh();
  const std::size_t pair = find_pair(context, quantity.pair);
  const auto body_of = [&](const std::string& set) { return mesh.blocks[mesh.side_sets.at(set).sides.front().block].body; };
  const auto touched = [&](LocalOrdinal body) {
    int pairs = 0;
    for (const auto& one : context.pairs)
      for (const auto& set : {one.slave, one.master})
        pairs += std::any_of(mesh.side_sets.at(set).sides.begin(), mesh.side_sets.at(set).sides.end(),
                             [&](const Side& s) { return mesh.blocks[s.block].body == body; });
    return pairs;
  };
  const auto force = nodal_force_->getLocalViewHost(Tpetra::Access::ReadOnly);
  const LocalOrdinal master = body_of(context.pairs[pair].master), slave = body_of(context.pairs[pair].slave);
  if (touched(master) != 1 && touched(slave) != 1) return none;
  const LocalOrdinal body = touched(master) == 1 ? master : slave;
  double sum = 0.0;
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    if (mesh.body_of_node[node] == body) sum += force(mesh.dimension * node + static_cast<int>(quantity.component), 0);
  return body == master ? sum : -sum;
}

double PeerEvaluation::evaluate(const Quantity& quantity, QuantityEvaluator& evaluator, const QuantityContext& context) const {
  if (const auto* force = dynamic_cast<const ContactForce*>(&quantity)) return contact_force(*force, context);
  return can_be_had(quantity) ? evaluator.evaluate(context) : none;
}

std::vector<double> PeerEvaluation::quantities(const QuantityEvaluators& evaluators) const {
  QuantityContext context = this->context();
  for (std::size_t i = 0; i < evaluators.size(); ++i)
    context.earlier_values.push_back(evaluate(*scene_.quantities[i].value.quantity.options, *evaluators[i], context));
  return context.earlier_values;
}

std::vector<std::vector<ProfilePoint>> PeerEvaluation::profiles() const {
  std::vector<std::vector<ProfilePoint>> profiles;
  const auto pairs = context().pairs;
  const FieldState state{*model_.bodies(), model_.contact().get(), *displacement_, *local_displacement_, laws_ ? &*laws_ : nullptr};
  for (std::size_t pair = 0; pair < pairs.size(); ++pair) profiles.push_back(ContactProfile(*model_.mesh(), pairs[pair], pair).points(state));
  return profiles;
}

}  // namespace mortise
