#pragma once

#include "mortise/contact/formulation.hpp"

namespace mortise {

/// Dual multipliers, condensed (Wohlmuth 2000; Hueber, Wohlmuth 2005; Popp, Gee, Wall 2009).
struct DualMortar : Formulation {
  void describe(Parameters&) override {}  ///< no parameters
  Coupling coupling() const override { return Coupling::dual_mortar; }
  Elimination elimination() const override { return Elimination::momentum; }
};

}  // namespace mortise
