#include "readers/gmsh/gmsh_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace mortise {
namespace {

/// Cells of a group that occur in the file more than once, as their entity is in several physical groups.
std::vector<std::int32_t> cells_with_copies(const GmshMesh& mesh, std::int32_t group) {
  std::vector<std::int32_t> cells;
  for (const auto& [entity, ranges] : mesh.entity_cells) {
    const auto physical = mesh.physical_of_entity.find(entity);
    if (physical == mesh.physical_of_entity.end() || physical->second.size() < 2) continue;
    for (const FileCellRange& range : ranges)
      if (range.group == group)
        for (std::int32_t c = 0; c < range.count; ++c) cells.push_back(range.first + c);
  }
  return cells;
}

/// new_place[cell] of a group when of cells with the same nodes the first alone stays; `stays[cell]` says which do.
std::vector<std::int32_t> places_without_copies(const FileCells& cells, std::vector<std::int32_t> suspects, std::vector<char>& stays) {
  const auto nodes = static_cast<std::size_t>(topology(cells.shape).nodes);
  const auto begin = [&](std::int32_t cell) { return cells.nodes.begin() + static_cast<std::ptrdiff_t>(nodes * static_cast<std::size_t>(cell)); };
  const auto end = [&](std::int32_t cell) { return begin(cell) + static_cast<std::ptrdiff_t>(nodes); };
  std::sort(suspects.begin(), suspects.end(), [&](std::int32_t a, std::int32_t b) {
    const auto order = std::mismatch(begin(a), end(a), begin(b));
    return order.first == end(a) ? a < b : *order.first < *order.second;
  });
  std::vector<std::int32_t> original(cells.labels.size());
  std::iota(original.begin(), original.end(), 0);
  for (std::size_t s = 1; s < suspects.size(); ++s)
    if (std::equal(begin(suspects[s]), end(suspects[s]), begin(suspects[s - 1]))) original[suspects[s]] = original[suspects[s - 1]];
  stays.assign(original.size(), 0);
  std::vector<std::int32_t> place(original.size());
  std::int32_t next = 0;
  for (std::size_t c = 0; c < original.size(); ++c) {
    stays[c] = original[c] == static_cast<std::int32_t>(c);
    place[c] = stays[c] ? next++ : place[original[c]];
  }
  return place;
}

void move_ranges(std::map<GmshTag, std::vector<FileCellRange>>& sets, std::int32_t group, const std::vector<std::int32_t>& place) {
  for (auto& [tag, ranges] : sets) {
    std::vector<FileCellRange> moved;
    for (const FileCellRange& range : ranges) {
      if (range.group != group)
        add_cells(moved, range);
      else
        for (std::int32_t c = 0; c < range.count; ++c) add_cells(moved, {group, place[range.first + c], 1});
    }
    ranges = std::move(moved);
  }
}

template <class Entry>
void keep(std::vector<Entry>& entries, const std::vector<char>& stays, std::size_t width) {
  std::size_t to = 0;
  for (std::size_t c = 0; c < stays.size(); ++c) {
    if (!stays[c]) continue;
    for (std::size_t i = 0; i < width; ++i) entries[to++] = entries[c * width + i];
  }
  entries.resize(to);
}

std::string word_for(int dimension) {
  static const std::array<const char*, 4> words{"point", "curve", "surface", "volume"};
  return words[static_cast<std::size_t>(std::clamp(dimension, 0, 3))];
}

/// The names of a group: those of $PhysicalNames, else its dimension and tag. A name that groups of several dimensions have tells which one.
std::vector<std::string> names_of_group(const GmshMesh& mesh, const GmshTag& tag, const std::map<std::string, std::set<int>>& dimensions) {
  const auto found = mesh.names.find(tag);
  if (found == mesh.names.end()) return {fmt::format("physical {} {}", word_for(tag.first), tag.second)};
  std::vector<std::string> names;
  for (const std::string& name : found->second)
    names.push_back(dimensions.at(name).size() > 1 ? fmt::format("{} ({})", name, word_for(tag.first)) : name);
  return names;
}

}  // namespace

FileCellRange read_gmsh_nodes_of(GmshNumbers& numbers, GmshMesh& mesh, const GmshElementType& type, std::int64_t label, std::int64_t spot) {
  std::array<std::int32_t, most_cell_nodes> nodes{};
  bool known = true;
  for (int n = 0; n < type.nodes; ++n) {
    const std::int64_t at = numbers.spot(), node = numbers.label("the label of a node");
    nodes[n] = mesh.nodes.find(node);
    if (nodes[n] >= 0) continue;
    numbers.error_at(at, fmt::format("element {}: there is no node {}", label, node));
    known = false;
  }
  if (!type.shape) return {-1, nodes[0], known ? 1 : 0};
  const std::int32_t group = group_of(mesh.file.cells, *type.shape);
  mesh.spots.resize(mesh.file.cells.size());
  FileCells& cells = mesh.file.cells[group];
  const auto cell = static_cast<std::int32_t>(cells.labels.size());
  if (!known) return {group, cell, 0};
  for (const int place : type.order) cells.nodes.push_back(nodes[place]);
  cells.labels.push_back(label);
  mesh.spots[group].push_back(spot);
  return {group, cell, 1};
}

void index_gmsh_nodes(GmshNumbers& numbers, GmshMesh& mesh, const std::vector<std::int64_t>& spots) {
  mesh.nodes = LabelTable(mesh.file.node_labels);
  if (const auto& twice = mesh.nodes.repeated())
    numbers.stop_at(spots[(*twice)[1]], fmt::format("node {} stands twice; the first is at {} {}", mesh.file.node_labels[(*twice)[1]],
                                                    numbers.binary() ? "byte" : "line", spots[(*twice)[0]]));
}

const GmshElementType& require_gmsh_type(GmshNumbers& numbers, std::int64_t number, std::int64_t spot) {
  const GmshElementType* const type = gmsh_element_type(number);
  if (type == nullptr) numbers.stop_at(spot, "an element of " + why_gmsh_type_is_refused(number));
  return *type;
}

void merge_gmsh_copies(GmshMesh& mesh) {
  for (std::size_t g = 0; g < mesh.file.cells.size(); ++g) {
    const auto group = static_cast<std::int32_t>(g);
    std::vector<std::int32_t> suspects = cells_with_copies(mesh, group);
    if (suspects.empty()) continue;
    FileCells& cells = mesh.file.cells[g];
    std::vector<char> stays;
    const std::vector<std::int32_t> place = places_without_copies(cells, std::move(suspects), stays);
    move_ranges(mesh.physical_cells, group, place);
    move_ranges(mesh.entity_cells, group, place);
    keep(cells.nodes, stays, static_cast<std::size_t>(topology(cells.shape).nodes));
    keep(cells.labels, stays, 1);
    keep(mesh.spots[g], stays, 1);
  }
}

void require_distinct_gmsh_elements(GmshNumbers& numbers, const GmshMesh& mesh) {
  std::vector<std::int64_t> labels, spots;
  for (std::size_t g = 0; g < mesh.file.cells.size(); ++g) {
    labels.insert(labels.end(), mesh.file.cells[g].labels.begin(), mesh.file.cells[g].labels.end());
    spots.insert(spots.end(), mesh.spots[g].begin(), mesh.spots[g].end());
  }
  if (labels.size() > static_cast<std::size_t>(most_indices))
    numbers.stop_at(0, fmt::format("the file has {} elements, above {}, the most that is read", labels.size(), most_indices));
  const LabelTable table(labels);
  if (const auto& twice = table.repeated())
    numbers.stop_at(spots[(*twice)[1]], fmt::format("element {} stands twice; the first is at {} {}", labels[(*twice)[1]],
                                                    numbers.binary() ? "byte" : "line", spots[(*twice)[0]]));
}

void name_gmsh_sets(GmshMesh& mesh) {
  const bool has_groups = !mesh.physical_cells.empty() || !mesh.physical_points.empty();
  std::map<std::string, std::set<int>> dimensions;
  for (const auto& [tag, names] : mesh.names)
    for (const std::string& name : names) dimensions[name].insert(tag.first);
  for (const auto& [name, all] : dimensions)
    if (all.size() > 1)
      mesh.file.notes.push_back(fmt::format("\"{}\" names groups of several dimensions; each is called by its dimension too", name));
  const auto names = [&](const GmshTag& tag) {
    return has_groups ? names_of_group(mesh, tag, dimensions) : std::vector<std::string>{fmt::format("{} {}", word_for(tag.first), tag.second)};
  };
  SetsInOrder<FileCellRange> cell_sets;
  for (const auto& [tag, ranges] : has_groups ? mesh.physical_cells : mesh.entity_cells)
    for (const std::string& name : names(tag)) {
      auto& members = cell_sets[name];
      members.insert(members.end(), ranges.begin(), ranges.end());
    }
  SetsInOrder<std::int32_t> node_sets;
  for (const auto& [tag, nodes] : has_groups ? mesh.physical_points : mesh.entity_points)
    for (const std::string& name : names(tag)) {
      auto& members = node_sets[name];
      members.insert(members.end(), nodes.begin(), nodes.end());
    }
  mesh.file.cell_sets = cell_sets.take();
  for (auto& set : mesh.file.cell_sets) join_ranges(set.members);
  mesh.file.node_sets = node_sets.take();
}

}  // namespace mortise
