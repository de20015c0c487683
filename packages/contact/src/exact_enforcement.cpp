#include "mortise/contact/enforcement/exact.hpp"

namespace mortise {

// A component that is prescribed takes one tangent: what the bound says is of the rest of the traction.
Complementarity ExactEnforcement::law(const ContactNode& node) const {
  if (!is_closed(node)) return open_node(node.z);
  const Frame in = node.frame();
  const double c = node.constant;
  if (!node.friction) return closed_node(c, node.gap, in, node.z);
  SpatialVector borne = node.z;
  if (node.holds_first_tangent) borne -= in.tangents.row(0).dot(node.z) * in.tangents.row(0).transpose();
  return with_friction(c, c, node.gap, node.slip, in, borne, (*node.friction)(node.z.dot(node.normal) - c * node.gap));
}

}  // namespace mortise
