// Elements that are quadratic triangles.

#include "elements/kernel_block.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Triangle6, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics, double);

}  // namespace mortise
