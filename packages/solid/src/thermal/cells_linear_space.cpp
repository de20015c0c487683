// Linear elements in 3D whose law knows the temperature.

#include "mortise/shape/hexahedron8.hpp"
#include "mortise/shape/pyramid5.hpp"
#include "mortise/shape/tetrahedron4.hpp"
#include "mortise/shape/wedge6.hpp"
#include "thermal/coupled_block.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_thermal_block<Hexahedron8, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                     const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Hexahedron8, ElementFormulation::f_bar>(const BlockContext&, std::size_t,
                                                                                                  const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Tetrahedron4, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                      const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Wedge6, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Pyramid5, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                  const MaterialOptions&, Kinematics, double);

}  // namespace mortise
