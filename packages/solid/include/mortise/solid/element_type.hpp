#pragma once
// Composition of a body: kinematics, elements, and which of their combinations with a law have a meaning. Holds the registry of elements.

#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/material/material_options.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// Two unknowns a node, and how the third direction behaves (axisymmetric: x is the radius r, y the axis z); or three unknowns a node.
enum class Kinematics { plane_strain, plane_stress, axisymmetric, three_dimensional };

/// Unknowns a node: 3 in three dimensions, else 2.
constexpr int dimension(Kinematics kinematics) { return kinematics == Kinematics::three_dimensional ? 3 : 2; }

/// F-bar takes the volume change of an element from its centre, which ends volumetric locking.
enum class ElementFormulation { standard, f_bar };

/// Elements, for run time. The order of the names means nothing.
enum class ElementType { q4, q4_f_bar, t3, q8, t6, h8, h8_f_bar, tet4, h20, tet10, w6, w15, p5 };

/// A line of the registry: an element with its cell and formulation. Its loops are compiled in a source of the cell, src/cells_<cell>.cpp.
template <class Type, ElementFormulation of_element = ElementFormulation::standard>
struct ElementEntry {
  using Cell = Type;                                             ///< its shape
  static constexpr ElementFormulation formulation = of_element;  ///< treatment of the deformation
  ElementType type;                                              ///< for run time
  const char* name;                                              ///< its name
  const char* sentence;                                          ///< its description, for people
};

/// All elements, in the order in which people see them.
inline constexpr std::tuple element_registry{
    ElementEntry<Quadrilateral4>{ElementType::q4, "Q4", "bilinear quadrilateral; every law, the kinematics of the plane"},
    ElementEntry<Quadrilateral4, ElementFormulation::f_bar>{ElementType::q4_f_bar, "Q4 F-bar",
                                                            "bilinear quadrilateral with the volume change of its centre, for nearly incompressible "
                                                            "states; finite strain, plane strain and axisymmetric"},
    ElementEntry<Triangle3>{ElementType::t3, "T3", "linear triangle; every law, the kinematics of the plane"},
    ElementEntry<Quadrilateral8>{ElementType::q8, "Q8", "serendipity quadrilateral of 8 nodes"},
    ElementEntry<Triangle6>{ElementType::t6, "T6", "quadratic triangle"},
    ElementEntry<Hexahedron8>{ElementType::h8, "H8", "trilinear hexahedron; three dimensional"},
    ElementEntry<Hexahedron8, ElementFormulation::f_bar>{
        ElementType::h8_f_bar, "H8 F-bar",
        "trilinear hexahedron with the volume change of its centre, for nearly incompressible states; finite strain, three dimensional"},
    ElementEntry<Tetrahedron4>{ElementType::tet4, "Tet4", "linear tetrahedron; three dimensional"},
    ElementEntry<Hexahedron20>{ElementType::h20, "H20", "serendipity hexahedron of 20 nodes; three dimensional"},
    ElementEntry<Tetrahedron10>{ElementType::tet10, "Tet10", "quadratic tetrahedron; three dimensional"},
    ElementEntry<Wedge6>{ElementType::w6, "W6", "linear wedge of 6 nodes; three dimensional"},
    ElementEntry<Wedge15>{ElementType::w15, "W15", "serendipity wedge of 15 nodes; three dimensional"},
    ElementEntry<Pyramid5>{ElementType::p5, "P5", "pyramid of 5 nodes, between hexahedra and tetrahedra; three dimensional"}};

/// visitor(entry) for each entry of the registry.
template <class Visitor>
void visit_each_element(Visitor&& visitor) {
  std::apply([&](const auto&... entry) { (visitor(entry), ...); }, element_registry);
}

/// visitor(entry) for the element's entry; what it returns has one type for all elements. Call it once a block of elements.
template <class Visitor, std::size_t place = 0>
decltype(auto) visit_element(ElementType type, Visitor&& visitor) {
  const auto& entry = std::get<place>(element_registry);
  if (entry.type == type) return visitor(entry);
  if constexpr (place + 1 < std::tuple_size_v<decltype(element_registry)>) return visit_element<Visitor&, place + 1>(type, visitor);
  throw std::logic_error("an element that is not in the registry");
}

/// "plane strain", "plane stress", "axisymmetric", "three dimensional".
const std::vector<std::pair<std::string, Kinematics>>& kinematics_names();

/// The names of all elements, in the order of the registry.
const std::vector<std::pair<std::string, ElementType>>& element_names();

CellShape cell_shape(ElementType type);
ElementFormulation formulation(ElementType type);
std::string to_string(ElementType type);
std::string to_string(Kinematics kinematics);

/// Composition of one body. The body's mesh is the block of the same index.
struct BodyProperties {
  std::string name;
  Place place;
  std::shared_ptr<const MaterialOptions> material;  ///< null: the body is rigid
  ElementType element = ElementType::q4;
  bool is_rigid() const { return material == nullptr; }
};

/// Reports what has no meaning. Empty if all is well. No communication.
///   - a 3D element with 2D kinematics, and the other way round;
///   - F-bar with small strain or plane stress;
///   - a law without a plane stress form under plane stress.
std::vector<Diagnostic> check_combination(const BodyProperties& body, Kinematics kinematics);

}  // namespace mortise
