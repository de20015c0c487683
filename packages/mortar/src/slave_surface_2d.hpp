#pragma once
// The slave side as one rank holds it: its nodes, the facets it evaluates, the ring of facets that shapes their normals.

#include <array>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "nodal_normal_2d.hpp"

namespace mortise {

/// Constant during the life of an interface. Nodes are numbered: owned slave nodes, other slave nodes of the facets evaluated here, ring.
struct SlaveSurface2d {
  std::vector<GlobalOrdinal> node_ids;
  std::vector<SlaveNode> owned;                      ///< the first nodes
  std::size_t nodes_with_normal = 0;                 ///< owned and other slave nodes: those that have a stencil
  std::vector<NormalStencil> stencils;               ///< [nodes with normal]
  std::vector<char> carries;                         ///< [nodes with normal] multiplier or not
  std::vector<std::array<LocalOrdinal, 2>> facets;   ///< evaluated here
  std::vector<std::array<double, 2>> facet_weights;  ///< [facets] int N_j over the reference facet
  std::vector<std::vector<std::size_t>> facets_of;   ///< [owned] facets that touch the node
};

/// Collective. Throws InputError at `place` for what MortarInterface refuses of a slave side.
SlaveSurface2d make_slave_surface_2d(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const RCP<const MultiVector>& fixed,
                                     const SurfaceFacets& facets, const InterfaceMeasure& measure, const Place& place);

}  // namespace mortise
