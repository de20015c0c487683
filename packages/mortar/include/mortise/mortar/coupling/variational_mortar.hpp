#pragma once

#include "mortise/mortar/coupling.hpp"

namespace mortise {

/// The integrals of standard mortar, with second derivatives of the gap; 2D only.
struct VariationalMortarCoupling final : Coupling {
  std::string name() const override { return "variational mortar"; }
  bool has_dual_multipliers() const override { return false; }
  bool has_dual_gap(GapWeighting) const override { return false; }
  bool has_forces_of_gaps() const override { return true; }
  /// Takes the nearest facet in the place of the master's normal, which its second derivatives do not know.
  CornerRule corner_rule(CornerRule asked, int dimension) const override;
  bool exists_in(int dimension) const override { return dimension == 2; }
  std::optional<std::string> refusal(const MortarOptions& options) const override;
};

}  // namespace mortise
