#pragma once

#include "mortise/contact/formulation.hpp"

namespace mortise {

/// Standard mortar whose normal forces are the derivatives of the weighted gaps, f = -z_n dg_j/dd: they do no work as long as gaps stay closed. 2D
/// only.
struct VariationalMortar : Formulation {
  void describe(Parameters&) override {}  ///< no parameters
  Coupling coupling() const override { return Coupling::variational_mortar; }
  Elimination elimination() const override { return Elimination::none; }
};

}  // namespace mortise
