#pragma once
// Conditions that hold exactly, with multipliers that are condensed or kept.

#include "mortise/contact/enforcement.hpp"

namespace mortise {

/// The complementarity functions closed_node() and with_friction(): closed where covered and z_n - c_n g > 0.
class ExactEnforcement : public Enforcement {
 public:
  Complementarity law(const ContactNode& node) const override;
  bool is_closed(const ContactNode& node) const override { return node.z.dot(node.normal) - node.constant * node.gap > 0.0; }
  bool holds_exactly() const override { return true; }
  bool depends_on_weight() const override { return false; }
  bool takes_ties() const override { return true; }
  double relative_constant() const override { return 1.0; }
};

/// Multipliers leave the system by the momentum rows of their slave nodes.
struct CondensedMultipliers final : ExactEnforcement {
  bool needs_diagonal_coupling() const override { return true; }
};

/// Multipliers stay unknowns.
struct KeptMultipliers final : ExactEnforcement {
  bool keeps_multipliers() const override { return true; }
};

}  // namespace mortise
