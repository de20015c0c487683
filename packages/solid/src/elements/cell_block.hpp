#pragma once
// Blocks of one kind of cell. Each kind is compiled in a file of its own: cells_<cell>.cpp.

#include "elements/element_block.hpp"

namespace mortise {

/// The block of elements with this cell and formulation; check_combination() has to accept law and kinematics.
template <class Cell, ElementFormulation formulation>
std::unique_ptr<ElementBlock> make_cell_block(const BlockContext& context, const Law& law, Kinematics kinematics, double thickness);

}  // namespace mortise
