#pragma once
// From a slave node and the master facets near it to its node-to-segment coupling and its derivatives (2D).

#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "nodal_normal.hpp"

namespace mortise {

/// A slave node as node-to-segment contact needs it.
struct SlaveNodeData {
  LocalOrdinal node = 0;
  const NormalStencil* stencil = nullptr;  ///< its facets
  const NodalNormal* normal = nullptr;
};

/// The node meets the master facet that the line along its normal n hits nearest, at most `reach` away:
///   x + s n = y(eta),   D_jj = w,   M_jl = w N_l(eta),   g_j = w s.
/// The node's share of the current surface is w = share sum_facets int N_j. The surface goes on straight for 1/200 of a facet beyond its ends.
/// @param masters  facets that may be hit, in an order that does not depend on the partition
/// @return false if none is; then `coupling` has no meaning
bool couple_node(const SlaveNodeData& slave, const std::vector<Facet<LocalOrdinal>>& masters, double reach, const Positions<2>& x,
                 const InterfaceMeasure& measure, double share, bool derivatives, FacetCoupling& coupling);

}  // namespace mortise
