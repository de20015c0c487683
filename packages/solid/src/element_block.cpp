#include "element_block.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>

#include "cell_block.hpp"
#include "mortise/material/materials.hpp"
#include "mortise/shape/hexahedron20.hpp"
#include "mortise/shape/hexahedron8.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/tetrahedron10.hpp"
#include "mortise/shape/tetrahedron4.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {

std::string element_place(const BlockContext& context, LocalOrdinal element) {
  const int nodes = context.block.nodes_per_element;
  std::array<double, 3> middle{};
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) middle[i] += context.mesh.coordinates[context.block.nodes(element)[a]][i] / nodes;
  return fmt::format("at ({:.6g}) of the reference configuration", fmt::join(middle.begin(), middle.begin() + context.mesh.dimension, ", "));
}

std::unique_ptr<ElementBlock> make_element_block(const BlockContext& context, const BodyProperties& body, Kinematics kinematics, double thickness) {
  constexpr auto standard = ElementFormulation::standard, f_bar = ElementFormulation::f_bar;
  const Law law = body.material->law();
  switch (body.element) {
    case ElementType::q4:
      return make_cell_block<Quadrilateral4, standard>(context, law, kinematics, thickness);
    case ElementType::q4_f_bar:
      return make_cell_block<Quadrilateral4, f_bar>(context, law, kinematics, thickness);
    case ElementType::t3:
      return make_cell_block<Triangle3, standard>(context, law, kinematics, thickness);
    case ElementType::q8:
      return make_cell_block<Quadrilateral8, standard>(context, law, kinematics, thickness);
    case ElementType::t6:
      return make_cell_block<Triangle6, standard>(context, law, kinematics, thickness);
    case ElementType::h8:
      return make_cell_block<Hexahedron8, standard>(context, law, kinematics, thickness);
    case ElementType::h8_f_bar:
      return make_cell_block<Hexahedron8, f_bar>(context, law, kinematics, thickness);
    case ElementType::tet4:
      return make_cell_block<Tetrahedron4, standard>(context, law, kinematics, thickness);
    case ElementType::h20:
      return make_cell_block<Hexahedron20, standard>(context, law, kinematics, thickness);
    case ElementType::tet10:
      return make_cell_block<Tetrahedron10, standard>(context, law, kinematics, thickness);
  }
  throw std::logic_error("an element type without elements");
}

}  // namespace mortise
