#pragma once

#include "mortise/contact/formulation.hpp"
#include "mortise/mortar/coupling/variational_mortar.hpp"

namespace mortise {

/// Standard mortar whose normal forces are the derivatives of the weighted gaps, f = -z_n dg_j/dd: they do no work as long as gaps stay closed. 2D
/// only.
struct VariationalMortar : Formulation {
  void describe(Parameters&) override {}  ///< no parameters
  SharedCoupling coupling() const override { return coupling_of<VariationalMortarCoupling>(); }
  SharedEnforcement enforcement() const override { return kept_multipliers(); }
};

}  // namespace mortise
