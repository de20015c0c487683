#pragma once

#include "mortise/mortar/coupling.hpp"

namespace mortise {

/// The integrals of dual mortar with phi_j = N_j, the gap weighted by N_j.
struct StandardMortarCoupling final : Coupling {
  std::string name() const override { return "standard mortar"; }
  bool has_dual_multipliers() const override { return false; }
  bool has_dual_gap(GapWeighting) const override { return false; }
};

}  // namespace mortise
