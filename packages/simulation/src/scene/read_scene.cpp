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

Scene make_scene(const XmlList& root) {
  std::vector<Diagnostic> diagnostics;
  Scene scene;
  scene.name = root.name;
  scene.symbols = read_symbols(root, diagnostics);
  read_parameters(scene, root, scene.symbols, {"variables", "tables"}, diagnostics);
  const auto wrong = check_scene(scene);
  diagnostics.insert(diagnostics.end(), wrong.begin(), wrong.end());
  if (diagnostics.empty()) diagnostics = wrong_combinations(scene);
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return scene;
}

}  // namespace mortise
