// Elements that are pyramids.

#include "elements/kernel_block.hpp"
#include "mortise/shape/pyramid5.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Pyramid5, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics, double);

}  // namespace mortise
