#pragma once
// Pressures that are a function of the mean gap.

#include <memory>
#include <utility>

#include "mortise/contact/enforcement.hpp"

namespace mortise {

struct PressureLaw;

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
  double onset() const override;

 private:
  std::shared_ptr<const PressureLaw> law_;
  double tangential_;
};

}  // namespace mortise
