#pragma once
// A fingerprint of the set of closed nodes.

#include <array>

#include "mortise/contact/contact_system.hpp"

namespace mortise::detail {

/// Collective: two sums of 32-bit hashes of (pair, node) over all closed nodes. Equal sets have equal sums on any number of ranks.
std::array<long long, 2> active_set_hash(const ContactSystem& contact, const ContactStates& states, const Communicator& comm);

}  // namespace mortise::detail
