// The resultant of a contact pair.

#include "mortise/simulation/quantities/quantity_support.hpp"

namespace mortise {
namespace {

double contact_force_of(const ContactForce& quantity, const QuantityContext& context, std::size_t of_pair) {
  const int i = static_cast<int>(quantity.component);
  // Edges have no friction.
  const double of_edges = context.edge_force && quantity.part != ContactForce::Part::tangential ? context.edge_force(of_pair)[i] : 0.0;
  if (quantity.part == ContactForce::Part::all) return resultant(*context.laws, of_pair)[i] + of_edges;
  double force = 0.0;
  const auto subtract = [&](std::size_t pair, double sign) {
    for (const auto& state : node_states(*context.laws, pair)) {
      const double normal = state.pressure * state.normal[i];
      force -= sign * state.covered * (quantity.part == ContactForce::Part::normal ? normal : state.traction[i] - normal);
    }
  };
  subtract(of_pair, 1.0);
  if (const auto other = context.contact->second_pass(of_pair)) subtract(*other, -1.0);
  return sum_over_ranks(context.mesh(), force) + of_edges;
}

}  // namespace

void ContactForce::describe(Parameters& parameters) {
  PairQuantity::describe(parameters);
  parameters.add("component", component, component_names(), "direction of the force on the slave side");
  parameters.add("part", part, {{"all", Part::all}, {"normal", Part::normal}, {"tangential", Part::tangential}},
                 "part of the force: all, the pressures along the nodes' normals, or the shear tractions across them");
}

std::unique_ptr<QuantityEvaluator> ContactForce::make_evaluator(const QuantityContext& context) const {
  const std::size_t of_pair = find_pair(context, pair);
  require_component(context, component);
  return evaluator_of([quantity = *this, of_pair](const QuantityContext& at) { return contact_force_of(quantity, at, of_pair); });
}

void add_contact_force(Registry<Quantity>& kinds) {
  kinds.add<ContactForce>("contact force", "sum of the contact forces on the slave side of a pair");
}

}  // namespace mortise
