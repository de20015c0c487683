#include <fmt/format.h>

#include <algorithm>

#include "mortise/simulation/model.hpp"
#include "names.hpp"
#include "precision.hpp"

namespace mortise {
namespace {

template <class T>
const Named<T>* find(const std::vector<Named<T>>& entries, const std::string& name) {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

namespace {

/// Positions of reference points have as many numbers as the scene has dimensions.
void check_position(const Scene& scene, const std::vector<double>& position, const Place& place, std::vector<Diagnostic>& diagnostics) {
  const std::size_t numbers = scene.kinematics == Kinematics::three_dimensional ? 3 : 2;
  if (!position.empty() && position.size() != numbers)
    diagnostics.push_back({place, fmt::format("the position of its reference point has {} numbers; a scene with kinematics \"{}\" needs {}",
                                              position.size(), to_string(scene.kinematics), numbers)});
}

}  // namespace

std::vector<Diagnostic> check_scene(const Scene& scene) {
  std::vector<Diagnostic> diagnostics;
  if (scene.bodies.empty()) diagnostics.push_back({{}, "the scene has no bodies; please add the list \"bodies\""});
  for (const auto& body : scene.bodies) {
    check_position(scene, body.value.reference_point, body.place, diagnostics);
    const auto& wanted = body.value.material;
    if (body.value.rigid.value && !body.value.reference_point.empty() && scene.kinematics == Kinematics::axisymmetric &&
        body.value.reference_point[0] != 0.0)
      diagnostics.push_back({body.place, "a rigid body in an axisymmetric scene moves along the axis only; please put its reference point on r = 0"});
    if (wanted.value.empty()) continue;  // said when it was read
    const auto* material = find(scene.materials, wanted.value);
    if (material == nullptr) {
      diagnostics.push_back({wanted.place, unknown_name("material", wanted.value, names_of(scene.materials))});
      continue;
    }
    if (material->value.law.options == nullptr) continue;
    const auto wrong = check_combination({body.name, body.place, material->value.law.options, body.value.element}, scene.kinematics);
    diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  }
  const auto moduli = moduli_out_of_range(scene);
  diagnostics.insert(diagnostics.end(), moduli.begin(), moduli.end());
  for (const auto& tie : scene.reference_points) check_position(scene, tie.value.position, tie.place, diagnostics);
  for (const auto& pair : scene.contact)
    if (!pair.value.slave.value.empty() && pair.value.slave.value == pair.value.master.value)
      diagnostics.push_back({pair.value.master.place, fmt::format("slave and master are the same set \"{}\"", pair.value.slave.value)});
  for (const auto& check : scene.checks) {
    const auto& wanted = check.value.quantity;
    if (!wanted.value.empty() && find(scene.quantities, wanted.value) == nullptr)
      diagnostics.push_back({wanted.place, unknown_name("quantity", wanted.value, names_of(scene.quantities))});
  }
  return diagnostics;
}

}  // namespace mortise
