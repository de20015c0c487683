// Elements that are linear tetrahedra.

#include "elements/kernel_block.hpp"
#include "mortise/shape/tetrahedron4.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Tetrahedron4, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics,
                                                                                                   double);

}  // namespace mortise
