#include "mortise/contact/formulation/augmented_lagrange.hpp"

#include <algorithm>

#include "mortise/contact/enforcement/augmented_lagrange.hpp"

namespace mortise {

void AugmentedLagrange::describe(Parameters& parameters) {
  Penalty::describe(parameters);
  parameters.add(
      "tolerance", tolerance,
      Says("error of the multipliers over the largest one of the pair at which a step is done, as estimated from the changes of the last updates")
          .unit("-")
          .above(0.0));
  parameters.add("augmentations", augmentations, Says("updates of the multipliers after which the step is undone").at_least(1));
}

SharedEnforcement AugmentedLagrange::enforcement() const {
  return std::make_shared<const AugmentedEnforcement>(normal, tangential.value_or(normal), MultiplierUpdates{tolerance, augmentations});
}

// A node moves by its force, z_n w, over a stiffness of the body. So its mean gap g / w answers to its traction by w / A_j times h/E, and where it is
// tied by sigma / w too. An update divides g / w by 1 + eps kappa h/E with kappa = w / A_j + sigma E / (h w): eps makes up for a small kappa.
double AugmentedEnforcement::stiffening(const ContactNode& node) const {
  const double tie = node.tie * node.youngs_modulus / (node.size * node.weight);
  return 1.0 / std::min(1.0, node.weight / node.full_weight + tie);
}

SpatialVector AugmentedEnforcement::return_map(const ContactNode& node) const {
  return mortise::return_map(regularised_node(node), node.gap, node.slip, node.weight, node.friction ? &*node.friction : nullptr);
}

double AugmentedEnforcement::stiffness(const ContactNode& node) const {
  const RegularisedNode regularised = regularised_node(node);
  return std::max(regularised.normal_stiffness, regularised.tangential_stiffness);
}

}  // namespace mortise
