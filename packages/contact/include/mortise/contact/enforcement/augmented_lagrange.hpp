#pragma once
// Penalty whose multipliers are updated.

#include <optional>

#include "mortise/contact/enforcement/penalty.hpp"

namespace mortise {

/// Penalty from the multipliers of the last update, with a stiffness that makes up for what is not covered.
class AugmentedEnforcement final : public PenaltyEnforcement {
 public:
  /// As PenaltyEnforcement.
  AugmentedEnforcement(double normal, double tangential, const MultiplierUpdates& updates)
      : PenaltyEnforcement(normal, tangential), updates_(updates) {}
  bool takes_ties() const override { return true; }
  SpatialVector start_from(const SpatialVector& traction) const override { return traction; }
  double stiffening(const ContactNode& node) const override;
  std::optional<MultiplierUpdates> updates() const override { return updates_; }
  SpatialVector return_map(const ContactNode& node) const override;
  double stiffness(const ContactNode& node) const override;

 private:
  MultiplierUpdates updates_;
};

}  // namespace mortise
