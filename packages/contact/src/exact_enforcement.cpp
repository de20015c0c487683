#include "mortise/contact/enforcement/exact.hpp"

namespace mortise {

// A node that is held sticks by a spring, a hundred times as stiff as a facet.
Complementarity ExactEnforcement::law(const ContactNode& node) const {
  if (!is_closed(node)) return open_node(node.z);
  const Frame in = node.frame();
  const double c = node.constant;
  if (!node.friction) return closed_node(c, node.gap, in, node.z);
  constexpr double stiff = 100.0;
  return with_friction(c, node.held.count > 0 ? stiff * c : c, node.gap, node.slip, in, node.z,
                       (*node.friction)(node.z.dot(node.normal) - c * node.gap), node.start_gap, node.held);
}

}  // namespace mortise
