#pragma once
// Column maps of matrices that get entries beyond those of another one.

#include <vector>

#include "mortise/core/types.hpp"

namespace mortise {

/// The ids of `columns` in their order, and after them, ascending, those of `further` (in any order, repeated or not) that are not among them: local
/// ids of the old map are those of the new one. Collective.
RCP<const Map> with_further_columns(const Map& columns, std::vector<GlobalOrdinal> further);

}  // namespace mortise
