#pragma once
// Column maps of matrices that get entries beyond those of another one.

#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// The ids of `columns` in their order, and after them, ascending, those of `further` that are not among them. `further` may be in any order and may
/// repeat ids. Local ids of the old map are those of the new one. Collective.
RCP<const Map> with_further_columns(const Map& columns, std::vector<GlobalOrdinal> further);

}  // namespace mortise
