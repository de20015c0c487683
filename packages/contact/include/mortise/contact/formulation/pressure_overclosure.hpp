#pragma once

#include <optional>

#include "mortise/contact/formulation.hpp"
#include "mortise/contact/pressure_law.hpp"
#include "mortise/contact/regularised.hpp"
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

/// The pressure of a law at the mean overclosure -g / w, and friction with a stiffness from the shear traction of the last accepted state. Hardly
/// covered nodes are tied: their force does not push their gap back, and of an exponential law they would bear any pressure.
class PressureOverclosureEnforcement final : public Enforcement {
 public:
  /// @param tangential  shear traction per mean slip before sliding [stress / length]
  PressureOverclosureEnforcement(std::shared_ptr<const PressureLaw> law, double tangential) : law_(std::move(law)), tangential_(tangential) {}
  Complementarity law(const ContactNode& node) const override;
  bool takes_ties() const override { return true; }
  bool starts_from_multipliers() const override { return true; }
  SpatialVector start_from(const SpatialVector& traction) const override;
  double onset() const override { return law_->onset(); }

 private:
  std::shared_ptr<const PressureLaw> law_;
  double tangential_;
};

}  // namespace mortise
