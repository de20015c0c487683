#include "mortise/simulation/scene/scene_bodies.hpp"

namespace mortise {

std::vector<BodyDescription> body_descriptions(const Scene& scene) {
  std::vector<BodyDescription> descriptions;
  for (const auto& body : scene.bodies)
    descriptions.push_back({body.name, body.place, body.value.mesh.options,
                            body.value.rigid.value ? rigid_shape(body.value.mesh.options->dimension()) : cell_shape(body.value.element)});
  return descriptions;
}

std::vector<std::string> contact_sides(const Scene& scene) {
  std::vector<std::string> sides;
  const auto add = [&](std::string name) {
    for (auto set = scene.sets.rbegin(); set != scene.sets.rend(); ++set)
      if (set->name == name) name = set->value.of.value;
    sides.push_back(name);
  };
  for (const auto& pair : scene.contact) add(pair.value.slave.value), add(pair.value.master.value);
  return sides;
}

}  // namespace mortise
