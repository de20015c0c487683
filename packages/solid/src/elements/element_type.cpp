#include "mortise/solid/element_type.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "mortise/core/names.hpp"
#include "mortise/material/materials.hpp"

namespace mortise {
namespace {

/// The names of the elements that have as many directions as the kinematics.
std::string elements_of(Kinematics kinematics) {
  std::string names;
  for (const auto& [name, type] : element_names())
    if (topology(cell_shape(type)).dimension == dimension(kinematics)) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
  return names;
}

/// The name of the element with the same cell and no F-bar.
std::string standard_element(ElementType type) {
  std::string name;
  visit_each_element([&](const auto& entry) {
    if (entry.formulation == ElementFormulation::standard && cell_shape(entry.type) == cell_shape(type)) name = entry.name;
  });
  return name;
}

/// The names of the laws that have a form for plane stress.
template <class... Laws>
std::string laws_of_plane_stress(const std::variant<Laws...>*) {
  std::vector<std::string> names;
  ((Laws::plane_stress ? names.push_back(Laws::name) : void()), ...);
  return quoted_list(names);
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
  static const std::vector<std::pair<std::string, ElementType>> names = [] {
    std::vector<std::pair<std::string, ElementType>> all;
    visit_each_element([&](const auto& entry) { all.emplace_back(entry.name, entry.type); });
    return all;
  }();
  return names;
}

CellShape cell_shape(ElementType type) {
  return visit_element(type, [](const auto& entry) { return shape_of<typename std::decay_t<decltype(entry)>::Cell>; });
}

ElementFormulation formulation(ElementType type) {
  return visit_element(type, [](const auto& entry) { return entry.formulation; });
}

std::string to_string(ElementType type) {
  return visit_element(type, [](const auto& entry) { return std::string(entry.name); });
}

std::string to_string(Kinematics kinematics) {
  for (const auto& [name, candidate] : kinematics_names())
    if (candidate == kinematics) return name;
  throw std::logic_error("kinematics without a name");
}

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
                             law.name, standard_element(body.element)));
        if (f_bar && kinematics == Kinematics::plane_stress)
          refuse(fmt::format("element \"{}\" has no meaning in plane stress, which does not lock; take \"Q4\"", to_string(body.element)));
        if (kinematics == Kinematics::plane_stress && !law.plane_stress)
          refuse(fmt::format("the material \"{}\" has no plane stress form; take one of {}", law.name,
                             laws_of_plane_stress(static_cast<Law*>(nullptr))));
      },
      body.material->law());
  return diagnostics;
}

}  // namespace mortise
