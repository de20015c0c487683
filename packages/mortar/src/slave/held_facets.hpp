#pragma once
// Slave facets that can carry no contact, as all their nodes are held.

#include <optional>
#include <string>
#include <vector>

#include "mortise/core/error.hpp"

namespace mortise {

/// Those that this rank counts: none is counted on two ranks.
struct HeldFacets {
  long held = 0, all = 0;
  bool prescribed = false, follow = false, shared = false;  ///< reasons why their nodes are held, or other pairs that have them
  bool quadratic = false;                                   ///< only the mid-side nodes are held
  std::vector<std::string> nodes;                           ///< of the first few, as text
};

/// Collective. One message for all of them, the same on every rank; none if no rank has one.
std::optional<Diagnostic> refusal_of(const HeldFacets& mine, const Communicator& comm, const Place& place);

/// Number of facets that the message names.
constexpr std::size_t named_facets = 3;

}  // namespace mortise
