// Elements that are quadratic tetrahedra.

#include "elements/kernel_block.hpp"
#include "mortise/shape/tetrahedron10.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Tetrahedron10, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics,
                                                                                                    double);

}  // namespace mortise
