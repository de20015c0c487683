#pragma once
// Shapes of cells in Exodus files.

#include <string>
#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// "QUAD4", "HEX20" ...; faces in a model of solids are "SHELL4". `dimension` is that of the model.
std::string exodus_name(CellShape shape, int dimension);

/// For each node of an Exodus element the node of the cell: they differ in the order of mid-side nodes.
std::vector<int> exodus_order(CellShape shape);

}  // namespace mortise
