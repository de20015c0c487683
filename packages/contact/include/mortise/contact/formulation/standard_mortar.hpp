#pragma once

#include "mortise/contact/formulation.hpp"
#include "mortise/mortar/coupling/standard_mortar.hpp"

namespace mortise {

/// Multipliers interpolated like displacements, phi_j = N_j; D is not diagonal, so they stay unknowns (Puso, Laursen 2004; Popp, Gee, Wall 2009).
struct StandardMortar : Formulation {
  void describe(Parameters&) override {}  ///< no parameters
  SharedCoupling coupling() const override { return coupling_of<StandardMortarCoupling>(); }
  SharedEnforcement enforcement() const override { return kept_multipliers(); }
};

}  // namespace mortise
