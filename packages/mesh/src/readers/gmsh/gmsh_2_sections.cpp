// The sections of Gmsh's format MSH 2.2.

#include <fmt/format.h>

#include <cstdlib>

#include "readers/gmsh/gmsh_mesh.hpp"

namespace mortise {
namespace {

/// Counts are text in binary files too.
std::int64_t count_in_text(GmshNumbers& numbers, const char* what, std::int64_t bytes_of_text, std::int64_t bytes) {
  std::string_view line;
  const std::int64_t at = numbers.stream().line(), byte = numbers.stream().offset();
  if (!numbers.stream().next_line(line)) line = {};
  while (!line.empty() && line.back() == ' ') line.remove_suffix(1);
  const auto count = whole_number_of(line);
  const std::int64_t spot = numbers.binary() ? byte : at;
  if (!count) numbers.stop_at(spot, fmt::format("expected {}, found \"{}\"", what, line));
  numbers.require_room(*count, what, spot, bytes_of_text, bytes);
  return *count;
}

/// The tags in front of the nodes of an element.
struct GmshTags {
  std::int64_t physical = 0, entity = 0;
};

GmshTags read_gmsh_tags(GmshNumbers& numbers, std::int64_t count) {
  GmshTags tags;
  for (std::int64_t t = 0; t < count; ++t) {
    const std::int64_t tag = numbers.whole("a tag");
    // The sign of a group says that its elements were turned round.
    if (t == 0) tags.physical = std::abs(tag);
    if (t == 1) tags.entity = tag;
  }
  return tags;
}

void read_gmsh_2_element(GmshNumbers& numbers, GmshMesh& mesh, const GmshElementType& type, std::int64_t label, std::int64_t tags,
                         std::int64_t spot) {
  const GmshTags of = read_gmsh_tags(numbers, tags);
  const GmshTag entity{type.dimension, of.entity}, physical{type.dimension, of.physical};
  const FileCellRange cell = read_gmsh_nodes_of(numbers, mesh, type, label, spot);
  if (of.physical != 0) mesh.physical_of_entity[entity].insert(of.physical);
  if (cell.group >= 0) {
    if (of.physical != 0) add_cells(mesh.physical_cells[physical], cell);
    add_cells(mesh.entity_cells[entity], cell);
  } else if (cell.count > 0) {
    if (of.physical != 0) mesh.physical_points[physical].push_back(cell.first);
    mesh.entity_points[entity].push_back(cell.first);
  }
}

void require_tag_count(GmshNumbers& numbers, std::int64_t tags, std::int64_t spot) {
  constexpr std::int64_t most = 1000000;
  if (tags < 0 || tags > most) numbers.stop_at(spot, fmt::format("the number of tags is {}, outside of 0 to {}", tags, most));
}

}  // namespace

void read_gmsh_2_nodes(GmshNumbers& numbers, GmshMesh& mesh) {
  const std::int64_t count = count_in_text(numbers, "the number of nodes", 8, 28);
  std::vector<std::int64_t> spots;
  spots.reserve(count);
  mesh.file.coordinates.reserve(count);
  mesh.file.node_labels.reserve(count);
  for (std::int64_t n = 0; n < count; ++n) {
    spots.push_back(numbers.spot());
    numbers.about("node after", n);
    const std::int64_t label = numbers.whole("the label of a node");
    numbers.about("node", label);
    const double x = numbers.real("coordinate x"), y = numbers.real("coordinate y"), z = numbers.real("coordinate z");
    mesh.file.node_labels.push_back(label);
    mesh.file.coordinates.push_back({x, y, z});
  }
  index_gmsh_nodes(numbers, mesh, spots);
}

void read_gmsh_2_elements(GmshNumbers& numbers, GmshMesh& mesh) {
  const std::int64_t count = count_in_text(numbers, "the number of elements", 8, 8);
  for (std::int64_t e = 0; e < count;) {
    std::int64_t spot = numbers.spot();
    numbers.about("element after", e);
    if (!numbers.binary()) {
      const std::int64_t label = numbers.whole("the label of an element");
      numbers.about("element", label);
      const GmshElementType& type = require_gmsh_type(numbers, numbers.whole("an element type"), spot);
      const std::int64_t tags = numbers.whole("the number of tags");
      require_tag_count(numbers, tags, spot);
      read_gmsh_2_element(numbers, mesh, type, label, tags, spot);
      ++e;
      continue;
    }
    const GmshElementType& type = require_gmsh_type(numbers, numbers.whole("an element type"), spot);
    const std::int64_t here = numbers.whole("the number of elements that follow"), tags = numbers.whole("the number of tags");
    require_tag_count(numbers, tags, spot);
    if (here <= 0 || here > count - e)
      numbers.stop_at(spot, fmt::format("{} elements follow, but 1 to {} of the {} announced are left", here, count - e, count));
    for (std::int64_t n = 0; n < here; ++n, ++e) {
      spot = numbers.spot();
      const std::int64_t label = numbers.whole("the label of an element");
      numbers.about("element", label);
      read_gmsh_2_element(numbers, mesh, type, label, tags, spot);
    }
  }
}

}  // namespace mortise
