#pragma once
// The mortar matrices of one tie in the reference configuration.

#include <utility>
#include <vector>

#include "mortise/mortar/tied_surfaces.hpp"

namespace mortise {

/// u_j = sum of coefficients times u at the nodes.
struct TieInterfaceRow {
  LocalOrdinal owned_node = 0;
  std::vector<std::pair<GlobalOrdinal, double>> sources;
};

/// Dual mortar of a tie where some nodes carry no multiplier. Facets without a multiplier are left out.
class TieInterface {
 public:
  /// Collective. `without` [owned nodes]: 1 where a node carries no multiplier.
  /// @throws InputError at the tie's place for what MortarInterface refuses, and for facets that cannot be integrated
  TieInterface(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const TiedPair& tie, const std::vector<char>& without,
               const InterfaceMeasure& measure);

  /// Of owned slave nodes with a multiplier that acts on a master.
  const std::vector<TieInterfaceRow>& rows() const { return rows_; }

 private:
  std::vector<TieInterfaceRow> rows_;
};

/// Cover of the slave nodes of a tie by masters.
struct TieCover {
  std::vector<char> on_slave;  ///< [owned nodes]
  std::vector<double> share;   ///< [owned nodes] of a slave node's weight
  GlobalOrdinal open = 0;      ///< slave nodes with less than least_tied_cover, over all ranks
};

/// Collective.
/// @throws InputError at the tie's place where nothing is covered, with the nearest node and its distance; and as TieInterface
TieCover measure_cover(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const TiedPair& tie,
                       const InterfaceMeasure& measure);

}  // namespace mortise
