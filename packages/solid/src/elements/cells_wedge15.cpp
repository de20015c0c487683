// Elements that are quadratic wedges.

#include "elements/kernel_block.hpp"
#include "mortise/shape/wedge15.hpp"
#include "thermal/coupled_block.hpp"

namespace mortise {

template std::unique_ptr<ElementBlock> make_cell_block<Wedge15, ElementFormulation::standard>(const BlockContext&, const Law&, Kinematics, double);
template std::unique_ptr<ElementBlock> make_thermal_block<Wedge15, ElementFormulation::standard>(const BlockContext&, std::size_t,
                                                                                                 std::unique_ptr<const ThermalLaw>, Kinematics,
                                                                                                 double);

}  // namespace mortise
