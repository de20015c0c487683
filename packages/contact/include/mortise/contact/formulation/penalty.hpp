#pragma once

#include "mortise/contact/formulation.hpp"

namespace mortise {

/// Tractions in proportion to penetration and to slip before sliding (Wriggers 2006, section 5.4).
struct Penalty : Formulation {
  Coupling discretisation = Coupling::dual_mortar;  ///< the integrals that it stands on
  double normal = 10.0;                             ///< stiffness over E / h
  std::optional<double> tangential;                 ///< the same along the surface; default: `normal`
  void describe(Parameters& parameters) override;
  Coupling coupling() const override { return discretisation; }
  Elimination elimination() const override { return Elimination::law; }
  std::optional<Regularisation> regularisation() const override { return Regularisation{normal, tangential.value_or(normal), 0, 0.0}; }
};

}  // namespace mortise
