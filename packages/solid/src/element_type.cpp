#include "mortise/solid/element_type.hpp"

#include <fmt/format.h>

namespace mortise {
namespace {

template <class Enum>
std::string name_of(const std::vector<std::pair<std::string, Enum>>& names, Enum value) {
  for (const auto& [name, candidate] : names)
    if (candidate == value) return name;
  throw std::logic_error("a value of an enumeration without a name");
}

}  // namespace

const std::vector<std::pair<std::string, Kinematics>>& kinematics_names() {
  static const std::vector<std::pair<std::string, Kinematics>> names{
      {"plane strain", Kinematics::plane_strain}, {"plane stress", Kinematics::plane_stress}, {"axisymmetric", Kinematics::axisymmetric}};
  return names;
}

const std::vector<std::pair<std::string, ElementType>>& element_names() {
  static const std::vector<std::pair<std::string, ElementType>> names{
      {"Q4", ElementType::q4}, {"Q4 F-bar", ElementType::q4_f_bar}, {"T3", ElementType::t3}};
  return names;
}

CellShape cell_shape(ElementType type) { return type == ElementType::t3 ? CellShape::triangle3 : CellShape::quadrilateral4; }

ElementFormulation formulation(ElementType type) { return type == ElementType::q4_f_bar ? ElementFormulation::f_bar : ElementFormulation::standard; }

std::string to_string(ElementType type) { return name_of(element_names(), type); }
std::string to_string(Kinematics kinematics) { return name_of(kinematics_names(), kinematics); }

std::vector<Diagnostic> check_combination(const BodyProperties& body, Kinematics kinematics) {
  std::vector<Diagnostic> diagnostics;
  if (body.is_rigid()) return diagnostics;
  std::visit(
      [&](const auto& law) {
        const bool f_bar = formulation(body.element) == ElementFormulation::f_bar;
        const auto refuse = [&](const std::string& what) { diagnostics.push_back({body.place, fmt::format("body \"{}\": {}", body.name, what)}); };
        if (f_bar && law.small_strain)
          refuse(fmt::format("element \"{}\" has no meaning with the material \"{}\"; take \"Q4\" or a finite strain law", to_string(body.element),
                             law.name));
        if (f_bar && kinematics == Kinematics::plane_stress)
          refuse(fmt::format("element \"{}\" has no meaning in plane stress, which does not lock; take \"Q4\"", to_string(body.element)));
        if (kinematics == Kinematics::plane_stress && !law.plane_stress)
          refuse(fmt::format("the material \"{}\" has no plane stress form; take \"{}\" or \"{}\"", law.name, StVenantKirchhoff::name,
                             SmallStrainLinear::name));
      },
      body.material->law());
  return diagnostics;
}

}  // namespace mortise
