#pragma once
// Sharing elements and nodes out among the ranks.

#include <string>
#include <vector>

#include "body_set.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Ids of the elements that this rank owns, ascending. Collective. `is_contact[body][side name index]` marks contact sides.
/// Rank 0 holds the dual graph while METIS partitions it. Throws std::runtime_error on all ranks if METIS fails.
std::vector<GlobalOrdinal> share_out_elements(const Communicator& comm, const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact);

/// One-to-one map of the nodes of the owned elements, ascending on every rank. Collective. Where the elements of several ranks meet, the
/// owner alternates with the pair of ranks, so that no rank takes all shared nodes.
/// `further_nodes` nodes with ids beyond those of the bodies go to rank 0.
RCP<const Map> share_out_nodes(const RCP<const Communicator>& comm, const BodySet& bodies, const std::vector<GlobalOrdinal>& owned_elements,
                               GlobalOrdinal further_nodes);

}  // namespace mortise
