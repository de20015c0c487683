// Elements of the plane whose law knows the temperature.

#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"
#include "thermal/coupled_block.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_thermal_block<Quadrilateral4, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                        const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Quadrilateral4, ElementFormulation::f_bar>(const BlockContext&, std::size_t,
                                                                                                     const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Triangle3, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                   const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Quadrilateral8, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                        const MaterialOptions&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Triangle6, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                   const MaterialOptions&, Kinematics, double);

}  // namespace mortise
