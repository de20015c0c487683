#pragma once
// Graphs with more couplings of nodes than elements make.

#include <set>
#include <utility>

#include "mortise/mesh/field_space.hpp"

namespace mortise {

/// A graph with further entries in rows of owned nodes: all components of the first field of pairs of nodes, by their ids. Its columns come after
/// those of `bulk`.
RCP<const Graph> widened(const Graph& bulk, const FieldSpace& space, const std::set<std::pair<GlobalOrdinal, GlobalOrdinal>>& coupled);

/// The graph itself if it holds the pairs in rows of owned nodes, else one that does. Collective.
RCP<const Graph> with_couplings(const RCP<const Graph>& bulk, const FieldSpace& space,
                                const std::set<std::pair<GlobalOrdinal, GlobalOrdinal>>& coupled);

/// The graph itself if it holds all entries of a matrix of nodes that are not 0, else one that does. Collective.
RCP<const Graph> with_entries_of(const RCP<const Graph>& bulk, const Matrix& of_nodes, const FieldSpace& space);

}  // namespace mortise
