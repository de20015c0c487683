// The registry of formats of mesh files.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "mortise/core/names.hpp"
#include "readers/readers.hpp"

namespace mortise {
namespace {

struct FormatEntry {
  MeshFormat format;
  const char* name;
  std::vector<std::string> endings;
  MeshFile (*read)(const std::string& path);
};

const std::vector<FormatEntry>& mesh_formats() {
  static const std::vector<FormatEntry> all{{MeshFormat::exodus, "Exodus II", {".exo", ".e", ".ex2", ".exoii", ".g", ".gen"}, read_exodus},
                                            {MeshFormat::gmsh, "Gmsh", {".msh"}, read_gmsh},
                                            {MeshFormat::abaqus, "Abaqus or CalculiX", {".inp"}, read_abaqus}};
  return all;
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

const FormatEntry& format_of(const std::string& path, MeshFormat format, const Place& place) {
  const std::string ending = ending_of(path);
  std::string known;
  for (const FormatEntry& entry : mesh_formats()) {
    const bool ends_so = std::find(entry.endings.begin(), entry.endings.end(), ending) != entry.endings.end();
    if (format == entry.format || (format == MeshFormat::by_name && ends_so)) return entry;
    known += fmt::format("{}{} ({})", known.empty() ? "" : "; ", fmt::join(entry.endings, ", "), entry.name);
  }
  throw InputError(
      place, fmt::format("the end of the name \"{}\" tells no format of meshes; known are {}. Rename the file, or give its format", path, known));
}

}  // namespace

MeshFile read_mesh_file(const std::string& path, MeshFormat format, const Place& place) { return format_of(path, format, place).read(path); }

}  // namespace mortise
