#pragma once
// Penalty: tractions in proportion to penetration and slip.

#include "mortise/contact/enforcement.hpp"
#include "mortise/contact/regularised.hpp"

namespace mortise {

/// Penalty: the law regularised(), from no normal traction and from the shear traction of the last accepted state.
class PenaltyEnforcement : public Enforcement {
 public:
  /// @param normal      stiffness over E / h: traction per mean gap is that times E / h
  /// @param tangential  the same along the surface
  PenaltyEnforcement(double normal, double tangential) : normal_(normal), tangential_(tangential) {}
  Complementarity law(const ContactNode& node) const override;
  bool starts_from_multipliers() const override { return true; }
  SpatialVector start_from(const SpatialVector& traction) const override;

 protected:
  RegularisedNode regularised_node(const ContactNode& node) const;  ///< stiffness at this node

 private:
  double normal_, tangential_;
};

}  // namespace mortise
