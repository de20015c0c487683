#pragma once

#include <optional>

#include "mortise/contact/formulation.hpp"
#include "mortise/contact/pressure_law.hpp"
#include "mortise/mortar/coupling/dual_mortar.hpp"

namespace mortise {

/// Pressures that are a given function of the mean gap: rough surfaces, gaskets, the laws of other programs.
struct PressureOverclosure : Formulation {
  SharedCoupling discretisation = coupling_of<DualMortarCoupling>();          ///< the integrals that it stands on
  Choice<PressureLaw> law{"linear", std::make_shared<LinearPressure>(), {}};  ///< the pressure
  std::optional<double> tangential;                                           ///< [stress / length]; default: the law's typical slope
  void describe(Parameters& parameters) override;
  SharedCoupling coupling() const override { return discretisation; }
  SharedEnforcement enforcement() const override;
};

}  // namespace mortise
