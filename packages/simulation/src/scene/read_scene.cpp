#include "mortise/simulation/scene/read_scene.hpp"

#include "mortise/input/read_parameters.hpp"
#include "mortise/simulation/scene/check_scene.hpp"
#include "mortise/simulation/scene/file_kind.hpp"
#include "scene/roles.hpp"
#include "scene/scene_combinations.hpp"

namespace mortise {

Scene read_scene(const Communicator& comm, const std::string& file, const std::vector<std::string>& settings) {
  XmlList root = parse_xml(read_text(comm, file), file);
  refuse_other_kinds(root, FileKind::scene);
  for (const auto& setting : settings) apply_override(root, setting);
  Scene scene = make_scene(root);
  assign_roles(comm, scene);
  return scene;
}

namespace {

/// Each copy becomes a body of its own, which says by how many steps it is away from the mesh.
void expand_patterns(Scene& scene) {
  std::vector<Named<BodyOptions>> bodies;
  for (const auto& body : scene.bodies) {
    const int copies = body.value.pattern.copies;
    for (int copy = 0; copy < copies; ++copy) {
      bodies.push_back(body);
      if (copy > 0) bodies.back().name += " " + std::to_string(copy + 1);
      bodies.back().value.pattern.copies = 1;
      bodies.back().value.pattern.begin += copy;
    }
  }
  scene.bodies = std::move(bodies);
}

}  // namespace

Scene make_scene(const XmlList& root) {
  std::vector<Diagnostic> diagnostics;
  Scene scene;
  scene.name = root.name;
  scene.symbols = read_symbols(root, diagnostics);
  read_parameters(scene, root, scene.symbols, {"variables", "tables"}, diagnostics);
  expand_patterns(scene);
  const auto wrong = check_scene(scene);
  diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  if (diagnostics.empty()) diagnostics = wrong_combinations(scene);
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return scene;
}

}  // namespace mortise
