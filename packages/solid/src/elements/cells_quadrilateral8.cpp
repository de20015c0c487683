// Elements that are quadratic quadrilaterals.

#include "elements/kernel_block.hpp"
#include "mortise/shape/quadrilateral8.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Quadrilateral8, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics,
                                                                                                     double);

}  // namespace mortise
