#pragma once

#include "mortise/contact/formulation.hpp"
#include "mortise/mortar/coupling/dual_mortar.hpp"

namespace mortise {

/// Dual multipliers, condensed (Wohlmuth 2000; Hueber, Wohlmuth 2005; Popp, Gee, Wall 2009).
struct DualMortar : Formulation {
  void describe(Parameters&) override {}  ///< no parameters
  SharedCoupling coupling() const override { return coupling_of<DualMortarCoupling>(); }
  SharedEnforcement enforcement() const override { return condensed_multipliers(); }
};

}  // namespace mortise
