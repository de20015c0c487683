#include "mortise/contact/formulation/penalty.hpp"

#include "mortise/contact/enforcement/penalty.hpp"

namespace mortise {

// Where forces are the gaps' derivatives, a law in the place of the multipliers would need these at all nodes that gaps depend on.
void Penalty::describe(Parameters& parameters) {
  std::vector<std::pair<std::string, SharedCoupling>> choices;
  for (const SharedCoupling& one : coupling_registry())
    if (!one->has_forces_of_gaps()) choices.emplace_back(one->name(), one);
  parameters.add("discretisation", discretisation, choices, "functions through which tractions act");
  parameters.add("stiffness", normal,
                 Says("traction per penetration, over Young's modulus of the softer side over the shortest slave facet").unit("-").above(0.0));
  parameters.add(
      "tangential stiffness", tangential,
      Says("shear traction per slip before sliding, over the modulus per length of `stiffness`; default: `stiffness`").unit("-").above(0.0));
}

SharedEnforcement Penalty::enforcement() const { return std::make_shared<const PenaltyEnforcement>(normal, tangential.value_or(normal)); }

RegularisedNode PenaltyEnforcement::regularised_node(const ContactNode& node) const {
  const double scale = node.youngs_modulus / node.size * node.start->stiffening * node.hardening;
  return {normal_ * scale, tangential_ * scale, node.constant * node.full_weight, node.full_weight, node.start->multiplier, node.start_gap};
}

Complementarity PenaltyEnforcement::law(const ContactNode& node) const {
  return regularised(regularised_node(node), node.gap, node.slip, node.weight, node.frame(), node.z, node.friction ? &*node.friction : nullptr);
}

SpatialVector PenaltyEnforcement::start_from(const SpatialVector& traction) const {
  SpatialVector shear = traction;
  shear[0] = 0.0;
  return shear;
}

}  // namespace mortise
