#pragma once

#include "mortise/contact/formulation.hpp"

namespace mortise {

/// Multipliers interpolated like displacements, phi_j = N_j; D is not diagonal, so they stay unknowns (Puso, Laursen 2004; Popp, Gee, Wall 2009).
struct StandardMortar : Formulation {
  void describe(Parameters&) override {}  ///< no parameters
  Coupling coupling() const override { return Coupling::standard_mortar; }
  Elimination elimination() const override { return Elimination::none; }
};

}  // namespace mortise
