#pragma once
// States of slave nodes.

#include <vector>

namespace mortise {

/// State of a slave node. A closed node without friction slips.
enum class ContactState { open = 0, stick = 1, slip = 2 };

/// States of the nodes of a pair, [owned slave nodes].
struct PairStates {
  std::vector<ContactState> states;  ///< open, stick or slip
  std::vector<char> covered;         ///< true if a multiplier has anything to act on
};
/// [pairs]
using ContactStates = std::vector<PairStates>;

}  // namespace mortise
