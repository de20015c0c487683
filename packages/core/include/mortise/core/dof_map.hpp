#pragma once
// Numbering of nodal unknowns: dof id = dimension * node id + component.

#include "mortise/core/types.hpp"

namespace mortise {

/// Map of the nodal dofs of a map of nodes, in the same order, components of a node together. Ids: dimension * node id + component.
RCP<const Map> make_dof_map(const Map& nodes, int dimension);

}  // namespace mortise
