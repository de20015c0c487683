#pragma once
// Sharing elements and nodes out among the ranks.

#include <string>
#include <vector>

#include "distribution/body_set.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// [body][1 + side name index] whether a side stands in `contact_sides` ("body/side"). [body][0]: sides without a name.
std::vector<std::vector<bool>> contact_flags(const BodySet& bodies, const std::vector<BodyDescription>& descriptions,
                                             const std::vector<std::string>& contact_sides);

/// Rank of each element by METIS: elements and those on contact sides are balanced. The whole mesh's graph is held here. Throws std::runtime_error.
std::vector<int> ranks_of_elements(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact, int ranks);

/// The owner of a node among the ranks whose elements hold it (in any order, with repeats): alternates, so that no rank takes all shared nodes.
int owner_among(std::vector<int> holders);

/// Ids of the elements that this rank owns, ascending, by ranks_of_elements() on rank 0. Collective.
/// Throws std::runtime_error on all ranks if METIS fails.
std::vector<GlobalOrdinal> share_out_elements(const Communicator& comm, const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact);

/// One-to-one map of the nodes of the owned elements, ascending on every rank, by owner_among(). Collective.
/// `further_nodes` nodes with ids beyond those of the bodies go to rank 0.
RCP<const Map> share_out_nodes(const RCP<const Communicator>& comm, const BodySet& bodies, const std::vector<GlobalOrdinal>& owned_elements,
                               GlobalOrdinal further_nodes);

}  // namespace mortise
