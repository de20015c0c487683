// Quadratic elements in 3D whose law knows the temperature.

#include "mortise/shape/hexahedron20.hpp"
#include "mortise/shape/tetrahedron10.hpp"
#include "mortise/shape/wedge15.hpp"
#include "thermal/coupled_block.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_thermal_block<Hexahedron20, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                      const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Tetrahedron10, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                       const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Wedge15, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                 const MaterialOptions&, Kinematics, double);

}  // namespace mortise
