#pragma once

#include "mortise/mortar/coupling.hpp"

namespace mortise {

/// Integrals over both surfaces' overlap with phi_j dual to N_j: D is diagonal.
struct DualMortarCoupling final : Coupling {
  std::string name() const override { return "dual mortar"; }
  bool has_dual_multipliers() const override { return true; }
  bool has_dual_gap(GapWeighting asked) const override { return asked == GapWeighting::dual; }
};

}  // namespace mortise
