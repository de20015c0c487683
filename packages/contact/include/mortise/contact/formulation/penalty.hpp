#pragma once

#include <optional>

#include "mortise/contact/formulation.hpp"
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

}  // namespace mortise
