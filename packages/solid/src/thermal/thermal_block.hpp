#pragma once
// Blocks of elements whose law knows the temperature. They are compiled in sources of their own: cells_*.cpp.

#include "elements/element_block.hpp"

namespace mortise {

/// The block of elements with this cell and formulation; check_combination() has to accept law and kinematics.
/// @param temperature  the field, which lives on all nodes of the block
template <class Cell, ElementFormulation formulation>
std::unique_ptr<ElementBlock> make_thermal_block(const BlockContext& context, std::size_t temperature, const MaterialOptions& material,
                                                 Kinematics kinematics, double thickness);

}  // namespace mortise
