#pragma once
// Elements that face one another across contact.

#include <array>
#include <vector>

#include "distribution/body_set.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Pairs of elements of two bodies that are nearest to one another. The distance is that of the midpoints of their sides in contact in the reference
/// configuration. There is no nearer such side of another body to either. At most one pair for a side, so that no element has many.
/// @param is_contact  [body][side name index]
std::vector<std::array<GlobalOrdinal, 2>> facing_elements(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact);

}  // namespace mortise
