#pragma once
// Blocks of elements whose law knows the temperature. Each kind of cell is compiled beside its other blocks: elements/cells_<cell>.cpp.

#include "elements/element_block.hpp"

namespace mortise {

/// The block of elements with this cell and formulation; check_combination() has to accept law and kinematics.
/// @param temperature  the field, which lives on all nodes of the block
template <class Cell, ElementFormulation formulation>
std::unique_ptr<ElementBlock> make_thermal_block(const BlockContext& context, std::size_t temperature, const MaterialOptions& material,
                                                 Kinematics kinematics, double thickness);

}  // namespace mortise
