#pragma once
// Blocks of elements whose law knows the temperature. Each kind of cell is compiled beside its other blocks: elements/cells_<cell>.cpp.

#include "elements/element_block.hpp"
#include "mortise/material/thermal_law.hpp"

namespace mortise {

/// The block of elements with this cell and formulation; check_combination() has to accept law and kinematics.
/// @param temperature  the field, which lives on all nodes of the block
/// @param law  with its plane stress form where the kinematics is that
template <class Cell, ElementFormulation formulation>
std::unique_ptr<ElementBlock> make_thermal_block(const BlockContext& context, std::size_t temperature, std::unique_ptr<const ThermalLaw> law,
                                                 Kinematics kinematics, double thickness);

}  // namespace mortise
