#pragma once

#include <optional>

#include "mortise/contact/formulation.hpp"
#include "mortise/contact/regularised.hpp"
#include "mortise/mortar/coupling/dual_mortar.hpp"

namespace mortise {

/// Tractions in proportion to penetration and to slip before sliding (Wriggers 2006, section 5.4).
struct Penalty : Formulation {
  SharedCoupling discretisation = coupling_of<DualMortarCoupling>();  ///< the integrals that it stands on
  double normal = 10.0;                                               ///< stiffness over E / h
  std::optional<double> tangential;                                   ///< the same along the surface; default: `normal`
  void describe(Parameters& parameters) override;
  SharedCoupling coupling() const override { return discretisation; }
  SharedEnforcement enforcement() const override;
};

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
