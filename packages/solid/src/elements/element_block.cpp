#include "elements/element_block.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <type_traits>

#include "elements/cell_block.hpp"
#include "mortise/material/materials.hpp"
#include "thermal/thermal_block.hpp"

namespace mortise {

std::string element_place(const BlockContext& context, LocalOrdinal element) {
  const int nodes = context.block.nodes_per_element;
  std::array<double, 3> middle{};
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) middle[i] += context.space.mesh()->coordinates[context.block.nodes(element)[a]][i] / nodes;
  return fmt::format("at ({:.6g}) of the reference configuration", fmt::join(middle.begin(), middle.begin() + context.space.mesh()->dimension, ", "));
}

StepFailure inverted(const BlockContext& context, LocalOrdinal element, double determinant) {
  return {FailureKind::inverted_element,
          fmt::format("body \"{}\": element {} {} is turned inside out, det F = {:.3g}", context.space.mesh()->body_of(context.block).name,
                      context.block.element_ids[element], element_place(context, element), determinant)};
}

StepFailure without_stress(const BlockContext& context, LocalOrdinal element, int point, double determinant, const std::string& why) {
  return {FailureKind::material,
          fmt::format("body \"{}\": {} at point {} of element {} {}, where det F = {:.3g}", context.space.mesh()->body_of(context.block).name, why,
                      point, context.block.element_ids[element], element_place(context, element), determinant)};
}

std::unique_ptr<ElementBlock> make_element_block(const BlockContext& context, const BodyProperties& body, Kinematics kinematics, double thickness,
                                                 std::optional<std::size_t> temperature, double heat_at_start) {
  return visit_element(body.element, [&](const auto& entry) {
    using Entry = std::decay_t<decltype(entry)>;
    if (temperature)
      return make_thermal_block<typename Entry::Cell, Entry::formulation>(
          context, *temperature, make_thermal_law(*body.material, kinematics == Kinematics::plane_stress, heat_at_start), kinematics, thickness);
    return make_cell_block<typename Entry::Cell, Entry::formulation>(context, body.material->law(), kinematics, thickness);
  });
}

}  // namespace mortise
