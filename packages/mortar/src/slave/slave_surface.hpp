#pragma once
// The slave side as one rank holds it: its nodes, the facets it evaluates, the ring of facets that shapes their normals.

#include <vector>

#include "mortise/mortar/mortar_interface.hpp"
#include "normals/nodal_normal.hpp"
#include "slave/facet_moments.hpp"

namespace mortise {

/// Constant during the life of an interface, but for what set_kinks() sets. Nodes are numbered: owned slave nodes, other slave
/// nodes of the facets evaluated here, ring.
struct SlaveSurface {
  std::vector<GlobalOrdinal> node_ids;
  std::vector<SlaveNode> owned;                     ///< the first nodes
  std::size_t nodes_with_normal = 0;                ///< owned and other slave nodes: those that have a stencil
  std::vector<NormalStencil> stencils;              ///< [nodes with normal], and behind them sides of kinks
  std::vector<char> carries;                        ///< [nodes with normal] multiplier or not
  std::vector<Facet<LocalOrdinal>> facets;          ///< evaluated here
  std::vector<Facet<LocalOrdinal>> normals;         ///< [facets] numbers of the stencils of the normals at its nodes
  std::vector<FacetMultipliers> multipliers;        ///< [facets]
  std::vector<std::vector<std::size_t>> facets_of;  ///< [owned] facets that touch the node

  /// True if a dual multiplier may act on a node of a facet: on those whose functions it has, the middle of an edge on corners too.
  bool may_load(int dimension, std::size_t facet, LocalOrdinal multiplier, LocalOrdinal node) const;
};

/// Collective. Throws InputError at `place` for what MortarInterface refuses of a slave side.
template <int dim>
SlaveSurface make_slave_surface(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const RCP<const MultiVector>& fixed,
                                const SurfaceFacets& facets, const InterfaceMeasure& measure, const Place& place);

/// int N_j over a facet: t L / 2, or 2 pi L (r_j / 3 + r_k / 6). Of quadratic facets int Ñ_j (see NonNegativeBasis).
FacetVector facet_weights(const FacetPoints<2>& x, const InterfaceMeasure& measure);
/// The same over a facet in 3D, where there is no other measure than its area.
FacetVector facet_weights(const FacetPoints<3>& x, const InterfaceMeasure& measure);

/// Rows of a view [nodes x dim] as points.
template <int dim, class View>
Positions<dim> positions_of(const View& view) {
  Positions<dim> x(view.extent(0));
  for (std::size_t n = 0; n < x.size(); ++n)
    for (int i = 0; i < dim; ++i) x[n][i] = view(n, i);
  return x;
}

}  // namespace mortise
