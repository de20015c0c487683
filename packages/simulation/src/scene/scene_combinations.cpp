#include "scene/scene_combinations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mortise/solid/element_type.hpp"

namespace mortise {
namespace {

/// Positions of reference points have as many numbers as the scene has dimensions.
void check_position(const Scene& scene, const std::vector<double>& position, const Place& place, std::vector<Diagnostic>& diagnostics) {
  const std::size_t numbers = scene.kinematics == Kinematics::three_dimensional ? 3 : 2;
  if (!position.empty() && position.size() != numbers)
    diagnostics.push_back({place, fmt::format("the position of its reference point has {} numbers; a scene with kinematics \"{}\" needs {}",
                                              position.size(), to_string(scene.kinematics), numbers)});
}

}  // namespace

std::vector<Diagnostic> wrong_combinations(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  for (const auto& body : scene.bodies) {
    check_position(scene, body.value.reference_point, body.place, diagnostics);
    if (body.value.rigid.value && !body.value.reference_point.empty() && scene.kinematics == Kinematics::axisymmetric &&
        body.value.reference_point[0] != 0.0)
      diagnostics.push_back({body.place, "a rigid body in an axisymmetric scene moves along the axis only; please put its reference point on r = 0"});
    const auto material =
        std::find_if(scene.materials.begin(), scene.materials.end(), [&](const auto& one) { return one.name == body.value.material.value; });
    if (material == scene.materials.end()) continue;  // a rigid body, or a name that is reported as unknown
    const auto wrong = check_combination({body.name, body.place, material->value.law.options, body.value.element}, scene.kinematics);
    diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  }
  for (const auto& tie : scene.reference_points) check_position(scene, tie.value.position, tie.place, diagnostics);
  return diagnostics;
}

}  // namespace mortise
