#include "mortise/studies/point_file.hpp"

#include "mortise/input/read_parameters.hpp"
#include "mortise/input/xml.hpp"
#include "mortise/simulation/scene/file_kind.hpp"

namespace mortise {
namespace {

struct MaterialList {
  Choice<MaterialOptions>& material;
  void describe(Parameters& parameters) { parameters.choose(material, material_registry(), "the law"); }
};

struct PathList {
  Choice<PointPath>& path;
  void describe(Parameters& parameters) { parameters.choose(path, point_path_registry(), "the kind of path"); }
};

}  // namespace

void PointFile::describe(Parameters& parameters) {
  parameters.add("stress unit", stress_unit, "unit of stress, for the axes of the plot");
  MaterialList materials{material};
  parameters.list("material", materials, "the material, as an entry of a scene's \"materials\"");
  PathList paths{path};
  parameters.list("path", paths, "deformation of the point");
}

PointFile read_point(const Communicator& comm, const std::string& file, const std::vector<std::string>& settings) {
  XmlList root = parse_xml(read_text(comm, file), file);
  refuse_other_kinds(root, FileKind::point);
  for (const auto& setting : settings) apply_override(root, setting);
  std::vector<Diagnostic> diagnostics;
  PointFile point;
  point.name = root.name;
  point.symbols = read_symbols(root, diagnostics);
  read_parameters(point, root, point.symbols, {"variables", "tables"}, diagnostics);
  if (!diagnostics.empty()) throw InputError(diagnostics);
  return point;
}

}  // namespace mortise
