#include <algorithm>

#include "mortise/contact/enforcement/exact.hpp"
#include "mortise/contact/formulation.hpp"

namespace mortise {

// The constant of the pair chooses the active set. The rows of C take no larger one than E / (h A_j). With 1e4 times that an error of 1e-3 h of a gap
// on Newton's way would count as a pressure of 10 E in the bound of friction. An error of 1e-3 h of a slip would count as ten times the bound.
Complementarity ExactEnforcement::law(const ContactNode& node) const {
  if (!is_closed(node)) return open_node(node.z);
  const Frame in = node.frame();
  const double c = std::min(node.constant, node.youngs_modulus / node.size / node.full_weight);
  if (!node.friction) return closed_node(c, node.gap, in, node.z);
  const double pressure = node.z.dot(node.normal) - c * node.gap;  // below 0 where the larger constant of the pair closes the node
  FrictionBound bound = (*node.friction)(std::max(0.0, pressure));
  if (pressure < 0.0) bound.slope = 0.0;
  return with_friction(c, c, node.gap, node.slip, in, node.z, bound, node.start_gap, node.held);
}

SharedEnforcement condensed_multipliers() { return std::make_shared<const CondensedMultipliers>(); }

SharedEnforcement kept_multipliers() { return std::make_shared<const KeptMultipliers>(); }

}  // namespace mortise
