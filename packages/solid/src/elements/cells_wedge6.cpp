// Elements that are linear wedges.

#include "elements/kernel_block.hpp"
#include "mortise/shape/wedge6.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Wedge6, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics, double);

}  // namespace mortise
