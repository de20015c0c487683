#pragma once
// Nodes where pairs meet.

#include <vector>

#include "mortise/contact/contact_pair.hpp"
#include "mortise/core/types.hpp"

namespace mortise::detail {

/// For each pair the marks of what is prescribed, with crosspoint_mark at its slave nodes that carry no multiplier of it:
///   - slaves of another pair too, in both. A node has one set of multipliers, and a corner cannot be pushed along two normals by one;
///   - masters of another pair, where the multiplier would be eliminated by the momentum of a node on which others act.
/// Their neighbours on the facets carry what they would. Nothing changes where no pairs meet: then all have `fixed` itself. Collective.
std::vector<RCP<const MultiVector>> with_crosspoints(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& fixed,
                                                     const std::vector<ContactPair>& pairs);

/// The marks of what is prescribed or follows, where `fixed` also has crosspoint_mark: nodes that carry no multiplier of any pair, but move.
RCP<const MultiVector> without_crosspoints(const RCP<const MultiVector>& fixed);

}  // namespace mortise::detail
