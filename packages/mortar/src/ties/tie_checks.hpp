#pragma once
// Nodes that ties share, and messages about ties that cannot hold.

#include <map>
#include <string>
#include <vector>

#include "mortise/mortar/tied_surfaces.hpp"

namespace mortise {

/// Marks of owned nodes, as facets see them whose nodes other ranks may own.
class NodeMarks {
 public:
  /// Collective. `marks` [owned nodes]
  NodeMarks(const RCP<const Map>& owned_nodes, const SurfaceFacets& facets, const std::vector<char>& marks);
  char operator[](GlobalOrdinal node) const { return marks_.at(node); }

 private:
  std::map<GlobalOrdinal, char> marks_;
};

/// Slave nodes of one tie that lie on others.
class TieMarks {
 public:
  /// Collective.
  TieMarks(const RCP<const Map>& owned_nodes, const std::vector<TiedPair>& ties);
  /// Another tie that an owned slave node of tie t lies on, as slave or as master; none: -1.
  int other(std::size_t t, std::size_t node) const;
  bool meets(std::size_t t, std::size_t node) const { return other(t, node) >= 0; }

 private:
  std::vector<std::vector<char>> slave_, master_;  ///< [ties][owned nodes]
};

/// Collective.
/// @throws InputError at tie t for slave facets all of whose nodes lie on other ties too
void refuse_shared_facets(const RCP<const Map>& owned_nodes, const MultiVector& reference, const TieMarks& marks, const std::vector<TiedPair>& ties,
                          std::size_t t);

/// "5 at (0, 1)".
std::string place_of_node(const SlaveNode& node, const MultiVector& reference);
/// The first of the texts of all ranks, in their order; empty: there is none. Collective.
std::string first_text(const Communicator& comm, const std::vector<std::string>& texts);

}  // namespace mortise
