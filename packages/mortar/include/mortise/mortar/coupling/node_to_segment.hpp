#pragma once

#include "mortise/mortar/coupling.hpp"

namespace mortise {

/// The master facet that the line along the nodal normal meets: phi_j is a point load of the node's share of the surface. Linear facets, 2D only.
struct NodeToSegmentCoupling final : Coupling {
  std::string name() const override { return "node to segment"; }
  bool has_dual_multipliers() const override { return false; }
  bool has_dual_gap(GapWeighting) const override { return false; }
  bool integrates_facets() const override { return false; }
  bool couple_node(const SlaveNodeData& slave, const std::vector<Facet<LocalOrdinal>>& masters, double reach, const std::vector<PlaneVector>& x,
                   const InterfaceMeasure& measure, double share, bool derivatives, FacetCoupling& coupling) const override;
  /// Takes the master's normal in the place of that of the nearest facet.
  CornerRule corner_rule(CornerRule asked, int) const override { return asked == CornerRule::averaged ? asked : CornerRule::master_normal; }
  bool exists_in(int dimension) const override { return dimension == 2; }
  bool takes_quadratic_facets() const override { return false; }
};

}  // namespace mortise
