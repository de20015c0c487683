// The registry of formats of mesh files.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mortise/core/names.hpp"
#include "readers/byte_stream.hpp"
#include "readers/collapsed_cells.hpp"
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

/// Kind of a file by its first bytes; nothing if they tell none of these.
struct Content {
  std::optional<MeshFormat> format;  ///< none: it is not read
  const char* name = nullptr;
};

std::optional<Content> content_of(const std::string& path) {
  ByteStream stream(path);
  stream.skip_byte_order_mark();
  std::string begin;
  for (int byte = stream.get(); byte >= 0 && begin.size() < 256; byte = stream.get()) begin += static_cast<char>(byte);
  const auto begins = [&](std::string_view with) { return begin.compare(0, with.size(), with) == 0; };
  const std::size_t word = begin.find_first_not_of(" \t\r\n");
  const std::string_view text = word == std::string::npos ? std::string_view() : std::string_view(begin).substr(word);
  const auto text_begins = [&](std::string_view with) { return text.substr(0, with.size()) == with; };
  if (begins("CDF") || begins("\x89HDF")) return Content{MeshFormat::exodus, "netCDF or HDF5, as Exodus II is"};
  if (text_begins("$MeshFormat") || text_begins("$NOD")) return Content{MeshFormat::gmsh, "a mesh of Gmsh"};
  if (begins("\x1F\x8B")) return Content{std::nullopt, "packed by gzip; please unpack it"};
  if (begins("\xFF\xFE") || begins("\xFE\xFF")) return Content{std::nullopt, "text in UTF-16; please save it in UTF-8"};
  if (text_begins("ISO-10303-21")) return Content{std::nullopt, "a drawing in STEP, which a mesh generator as Gmsh has to mesh"};
  if (text_begins("# vtk DataFile") || text.find("<VTKFile") != std::string_view::npos)
    return Content{std::nullopt, "a mesh in VTK's format; meshio converts it"};
  if (text_begins("solid ")) return Content{std::nullopt, "a surface in STL, which a mesh generator as Gmsh has to fill"};
  if (text_begins("MeshVersionFormatted")) return Content{std::nullopt, "a mesh in Medit's format; Gmsh or meshio converts it"};
  if (text.size() > 1 && text[0] == '*' && (text[1] == '*' || std::isalpha(static_cast<unsigned char>(text[1])))) {
    return Content{MeshFormat::abaqus, "an input file of Abaqus or CalculiX"};
  }
  return std::nullopt;
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
  const std::optional<Content> content = content_of(path);
  throw InputError(place, fmt::format("the end of the name \"{}\" tells no format of meshes; known are {}. {}Rename the file, or give its format",
                                      path, known, content ? fmt::format("By its content it is {}. ", content->name) : ""));
}

/// Refuses content of another format by its name, before a reader refuses its first line.
void require_content(const std::string& path, const FormatEntry& entry, MeshFormat given, const Place& place) {
  const std::optional<Content> content = content_of(path);
  if (!content || content->format == entry.format) return;
  const std::string what = fmt::format("\"{}\" is to be {} by its {}, and by its content it is {}", path, entry.name,
                                       given == MeshFormat::by_name ? "name" : "\"format\"", content->name);
  throw InputError(place,
                   content->format ? what + (given == MeshFormat::by_name ? "; rename the file, or give its format" : "; correct the format") : what);
}

}  // namespace

MeshFile read_mesh_file(const std::string& path, MeshFormat format, const Place& place) {
  const FormatEntry& entry = format_of(path, format, place);
  require_content(path, entry, format, place);
  MeshFile file = entry.read(path);
  replace_collapsed_cells(file);
  return file;
}

}  // namespace mortise
