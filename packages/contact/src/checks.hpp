#pragma once
// What several pairs must not have in common.

#include <vector>

#include "mortise/contact/contact_system.hpp"

namespace mortise::detail {

/// Collective. Throws InputError for a node that is slave in two pairs, or slave in one pair and master in another: its multiplier could
/// not be eliminated from its own rows.
void refuse_shared_nodes(const Map& owned_nodes, const std::vector<ContactPair>& pairs);

}  // namespace mortise::detail
