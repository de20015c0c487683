#pragma once
// Surfaces that are glued together: displacements of slave nodes as constant combinations of those of master nodes.

#include <string>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// One tie as the host application gives it.
struct TiedPair {
  std::string name;        ///< as messages say it
  Place place;             ///< where it is given
  SurfaceFacets slave;     ///< as MortarInterface wants them
  SurfaceFacets master;    ///< as MortarInterface wants them
  double tolerance = 0.0;  ///< distance up to which facets are tied [length]; above 0
};

/// The share of its weight that masters have to cover of a slave node that is tied. A node at the edge of a master has 1/2, at its corner 1/4.
inline constexpr double least_tied_cover = 0.2;

/// Numbers of slave nodes of a tie, over all ranks.
struct TieCount {
  GlobalOrdinal tied = 0;  ///< slave nodes of which a component follows the masters
  GlobalOrdinal open = 0;  ///< slave nodes that no master covers, or hardly
};

/// Ties of the whole model. With dual functions phi_j of slave node j and D_jk = int phi_j N_k, M_jl = int phi_j N_l over the reference surfaces
///   sum_k D_jk u_k = sum_l M_jl u_l,
/// in each component. Solved for u_j it is u_j = sum P_jk u_k. Its rows sum up to 1. The sources k are master nodes, and slave nodes without a
/// multiplier: those that are held in this component, lie on several ties, or are hardly covered. On quadratic facets D_jk couples a mid-side node
/// with corners, whose own rows are put in.
struct TieRows {
  std::vector<LocalOrdinal> dofs;   ///< owned dofs (dimension * owned node + component) that are tied, ascending
  std::vector<std::size_t> tie_of;  ///< [dofs] which tie they belong to
  RCP<const Matrix> T;              ///< [owned dofs squared] rows P of tied dofs, of others those of the identity; columns of tied dofs are empty
  std::vector<TieCount> counts;     ///< [ties]
};

/// Collective.
/// @param owned_nodes  one-to-one map of all nodes of the model
/// @param dofs         map of the owned dofs: dimension * node + component
/// @param reference    [owned nodes x dim] reference positions
/// @param held         [owned nodes x dim] not 0 where the displacement is prescribed or follows another than a tie
/// @throws InputError at the tie's place, on every rank, for
///   - a slave of which no facet has a master within the tolerance, or all nodes are held;
///   - a slave facet all of whose nodes belong to other ties too;
///   - what MortarInterface refuses.
TieRows tie_surfaces(const RCP<const Map>& owned_nodes, const RCP<const Map>& dofs, const RCP<const MultiVector>& reference,
                     const RCP<const MultiVector>& held, const std::vector<TiedPair>& ties, const InterfaceMeasure& measure);

}  // namespace mortise
