// Elements that are quadratic wedges.

#include "elements/kernel_block.hpp"
#include "mortise/shape/wedge15.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Wedge15, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics, double);

}  // namespace mortise
