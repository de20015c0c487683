#include "mortise/solid/element_type.hpp"

#include <fmt/format.h>

#include "mortise/material/materials.hpp"

namespace mortise {
namespace {

template <class Enum>
std::string name_of(const std::vector<std::pair<std::string, Enum>>& names, Enum value) {
  for (const auto& [name, candidate] : names)
    if (candidate == value) return name;
  throw std::logic_error("a value of an enumeration without a name");
}

/// The names of the elements that have as many directions as the kinematics.
std::string elements_of(Kinematics kinematics) {
  std::string names;
  for (const auto& [name, type] : element_names())
    if (topology(cell_shape(type)).dimension == dimension(kinematics)) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  return names;
}

}  // namespace

const std::vector<std::pair<std::string, Kinematics>>& kinematics_names() {
  static const std::vector<std::pair<std::string, Kinematics>> names{{"plane strain", Kinematics::plane_strain},
                                                                     {"plane stress", Kinematics::plane_stress},
                                                                     {"axisymmetric", Kinematics::axisymmetric},
                                                                     {"three dimensional", Kinematics::three_dimensional}};
  return names;
}

const std::vector<std::pair<std::string, ElementType>>& element_names() {
  static const std::vector<std::pair<std::string, ElementType>> names{{"Q4", ElementType::q4},
                                                                      {"Q4 F-bar", ElementType::q4_f_bar},
                                                                      {"T3", ElementType::t3},
                                                                      {"Q8", ElementType::q8},
                                                                      {"T6", ElementType::t6},
                                                                      {"H8", ElementType::h8},
                                                                      {"H8 F-bar", ElementType::h8_f_bar},
                                                                      {"Tet4", ElementType::tet4},
                                                                      {"H20", ElementType::h20},
                                                                      {"Tet10", ElementType::tet10}};
  return names;
}

CellShape cell_shape(ElementType type) {
  switch (type) {
    case ElementType::q4:
    case ElementType::q4_f_bar:
      return CellShape::quadrilateral4;
    case ElementType::t3:
      return CellShape::triangle3;
    case ElementType::q8:
      return CellShape::quadrilateral8;
    case ElementType::t6:
      return CellShape::triangle6;
    case ElementType::h8:
    case ElementType::h8_f_bar:
      return CellShape::hexahedron8;
    case ElementType::tet4:
      return CellShape::tetrahedron4;
    case ElementType::h20:
      return CellShape::hexahedron20;
    case ElementType::tet10:
      return CellShape::tetrahedron10;
  }
  throw std::logic_error("an element type without a shape");
}

ElementFormulation formulation(ElementType type) {
  return type == ElementType::q4_f_bar || type == ElementType::h8_f_bar ? ElementFormulation::f_bar : ElementFormulation::standard;
}

std::string to_string(ElementType type) { return name_of(element_names(), type); }
std::string to_string(Kinematics kinematics) { return name_of(kinematics_names(), kinematics); }

std::vector<Diagnostic> check_combination(const BodyProperties& body, Kinematics kinematics) {
  std::vector<Diagnostic> diagnostics;
  if (body.is_rigid()) return diagnostics;
  std::visit(
      [&](const auto& law) {
        const bool f_bar = formulation(body.element) == ElementFormulation::f_bar;
        const auto refuse = [&](const std::string& what) { diagnostics.push_back({body.place, fmt::format("body \"{}\": {}", body.name, what)}); };
        if (topology(cell_shape(body.element)).dimension != dimension(kinematics))
          refuse(fmt::format("element \"{}\" is made for {}, the kinematics is \"{}\"; take one of {}", to_string(body.element),
                             dimension(kinematics) == 3 ? "the plane" : "three dimensions", to_string(kinematics), elements_of(kinematics)));
        if (f_bar && law.small_strain)
          refuse(fmt::format("element \"{}\" has no meaning with the material \"{}\"; take \"{}\" or a finite strain law", to_string(body.element),
                             law.name, body.element == ElementType::q4_f_bar ? "Q4" : "H8"));
        if (f_bar && kinematics == Kinematics::plane_stress)
          refuse(fmt::format("element \"{}\" has no meaning in plane stress, which does not lock; take \"Q4\"", to_string(body.element)));
        if (kinematics == Kinematics::plane_stress && !law.plane_stress)
          refuse(fmt::format("the material \"{}\" has no plane stress form; take an elastic law, such as \"{}\"", law.name, Hencky::name));
      },
      body.material->law());
  return diagnostics;
}

}  // namespace mortise
