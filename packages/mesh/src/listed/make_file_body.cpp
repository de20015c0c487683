#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "listed/body_checks.hpp"
#include "listed/named_sets.hpp"
#include "mortise/mesh/file_body.hpp"

namespace mortise {
namespace {

/// The most dimensions of the cells that the body may be made of.
int most_dimensions(const MeshFile& file, const FileBodyRequest& request) {
  int highest = 0;
  for (const FileCells& cells : file.cells)
    if (request.blocks.empty() && !cells.labels.empty()) highest = std::max(highest, topology(cells.shape).dimension);
  for (const auto& set : file.cell_sets)
    if (std::find(request.blocks.begin(), request.blocks.end(), set.name) != request.blocks.end())
      for (const FileCellRange& range : set.members)
        if (range.count > 0) highest = std::max(highest, topology(file.cells[static_cast<std::size_t>(range.group)].shape).dimension);
  return highest;
}

int wanted_dimension(const MeshFile& file, const FileBodyRequest& request) {
  const int highest = most_dimensions(file, request);
  if (highest >= request.dimension || (highest == 0 && !request.blocks.empty())) return request.dimension;
  if (request.is_surface && highest == request.dimension - 1) return highest;
  static const char* const cells_of[] = {"no cells", "lines alone", "cells of two dimensions at most", "solid cells"};
  const std::string which =
      request.blocks.empty() ? file.path + " has" : fmt::format("blocks \"{}\" of {} have", fmt::join(request.blocks, "\", \""), file.path);
  throw InputError(request.place,
                   fmt::format("{} {}; body \"{}\" needs cells of {} dimensions{}", which, cells_of[highest], request.name, request.dimension,
                               request.is_surface ? fmt::format(" or, as it is rigid, of {}", request.dimension - 1) : ""));
}

/// Rows of pairs (row, value) that ascend.
void fill_rows(RowStore<std::int32_t>& store, std::int64_t rows, const std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(rows) + 1, 0);
  std::vector<std::int32_t> values;
  values.reserve(pairs.size());
  for (const auto& [row, value] : pairs) {
    ++offsets[static_cast<std::size_t>(row) + 1];
    values.push_back(value);
  }
  for (std::size_t row = 1; row < offsets.size(); ++row) offsets[row] += offsets[row - 1];
  store.assign(std::move(offsets), std::move(values));
}

void make_unique_pairs(std::vector<std::pair<std::int32_t, std::int32_t>>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

void fill_coordinates(ListedBody& body, const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen) {
  std::vector<std::int64_t> offsets{0};
  std::vector<double> values;
  offsets.reserve(chosen.file_nodes.size() + 1);
  values.reserve(3 * chosen.file_nodes.size());
  for (const std::int32_t node : chosen.file_nodes) {
    SpatialPoint x = file.coordinates[static_cast<std::size_t>(node)];
    for (double& component : x) component *= request.scale;
    if (request.dimension == 2) x[2] = 0.0;
    x = request.placement(x);
    values.insert(values.end(), x.begin(), x.end());
    offsets.push_back(static_cast<std::int64_t>(values.size()));
  }
  body.coordinates.assign(std::move(offsets), std::move(values));
}

void fill_elements_of_nodes(ListedBody& body, const BodyElements& elements) {
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(body.nodes) + 1, 0);
  for (const std::int32_t node : elements.nodes) ++offsets[static_cast<std::size_t>(node) + 1];
  for (std::size_t node = 1; node < offsets.size(); ++node) offsets[node] += offsets[node - 1];
  std::vector<std::int32_t> values(elements.nodes.size());
  auto next = offsets;
  for (std::int32_t e = 0; e < elements.size(); ++e)
    for (auto n = elements.offsets[static_cast<std::size_t>(e)]; n < elements.offsets[static_cast<std::size_t>(e) + 1]; ++n)
      values[static_cast<std::size_t>(next[static_cast<std::size_t>(elements.nodes[static_cast<std::size_t>(n)])]++)] = e;
  body.elements_of_node.assign(std::move(offsets), std::move(values));
}

void fill_labels(ListedBody& body, const BodyElements& elements) {
  std::vector<std::int64_t> offsets;
  for (std::int64_t e = 0; e <= elements.size(); ++e) offsets.push_back(e);
  body.labels.assign(std::move(offsets), {elements.labels.begin(), elements.labels.end()});
}

/// Names of sides at each node, and the surface itself.
void fill_sides_of_nodes(ListedBody& body, const BodyElements& elements, const std::vector<NamedSide>& sides) {
  std::vector<std::pair<std::int32_t, std::int32_t>> names;
  for (const NamedSide& side : sides)
    for (const std::int32_t node : nodes_of_side(elements, side.side)) {
      names.emplace_back(node, -1);
      if (side.name >= 0) names.emplace_back(node, side.name);
    }
  make_unique_pairs(names);
  fill_rows(body.sides_of_node, body.nodes, names);
}

void fill_elements(ListedBody& body, BodyElements elements, const std::vector<NamedSide>& sides) {
  std::vector<std::pair<std::int32_t, std::int32_t>> entries;
  for (const NamedSide& side : sides) {
    entries.emplace_back(side.side.element, side.side.side);
    entries.emplace_back(side.side.element, side.name);
  }
  fill_rows(body.surface_sides, elements.size(), entries);
  fill_sides_of_nodes(body, elements, sides);
  fill_elements_of_nodes(body, elements);
  fill_labels(body, elements);
  body.parts = std::move(elements.parts);
  body.element_nodes.assign(std::move(elements.offsets), std::move(elements.nodes));
}

/// The sides of solid cells become the elements, with their nodes alone.
void keep_surface(ChosenCells& chosen, BodySets& sets) {
  const auto shape = [&](const NamedSide& side) { return shape_of_side(chosen.elements, side.side); };
  std::stable_sort(sets.sides.begin(), sets.sides.end(), [&](const NamedSide& a, const NamedSide& b) { return shape(a) < shape(b); });
  std::vector<std::int32_t> number(chosen.file_nodes.size(), -1);
  for (const NamedSide& side : sets.sides)
    for (const std::int32_t node : nodes_of_side(chosen.elements, side.side)) number[static_cast<std::size_t>(node)] = 0;
  std::vector<std::int32_t> kept;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    number[node] = static_cast<std::int32_t>(kept.size());
    kept.push_back(chosen.file_nodes[node]);
  }
  BodyElements surface;
  const auto is_same = [](const NamedSide& a, const NamedSide& b) { return a.side.element == b.side.element && a.side.side == b.side.side; };
  std::vector<NamedSide> sides;
  for (std::size_t s = 0; s < sets.sides.size(); ++s) {
    const NamedSide& side = sets.sides[s];
    if (s == 0 || !is_same(side, sets.sides[s - 1])) {
      if (surface.parts.empty() || surface.parts.back().shape != shape(side)) surface.parts.push_back({"", shape(side), 0});
      ++surface.parts.back().elements;
      for (const std::int32_t node : nodes_of_side(chosen.elements, side.side)) surface.nodes.push_back(number[static_cast<std::size_t>(node)]);
      surface.offsets.push_back(static_cast<std::int64_t>(surface.nodes.size()));
      surface.labels.push_back(chosen.elements.labels[static_cast<std::size_t>(side.side.element)]);
    }
    sides.push_back({{surface.size() - 1, the_cell_itself}, side.name});
  }
  std::vector<std::pair<std::int32_t, std::int32_t>> set_of_node;
  for (const auto& [node, set] : sets.set_of_node)
    if (number[static_cast<std::size_t>(node)] >= 0) set_of_node.emplace_back(number[static_cast<std::size_t>(node)], set);
  chosen.elements = std::move(surface);
  chosen.file_nodes = std::move(kept);
  sets.sides = std::move(sides);
  sets.set_of_node = std::move(set_of_node);
}

BodySets sets_of(const MeshFile& file, const FileBodyRequest& request, ChosenCells& chosen, int dimension) {
  if (dimension < request.dimension) {
    require_one_orientation(file, request, chosen);
    return name_facets(file, request, chosen);
  }
  const SideTable table(chosen.elements, chosen.nodes());
  require_conforming(file, request, chosen, table);
  if (!request.is_surface) require_one_piece(file, request, chosen);
  BodySets sets = name_sets(file, request, chosen, table);
  if (!request.is_surface)
    if (const auto warning = loose_nodes(file, chosen, table)) sets.warnings.push_back(*warning);
  if (request.is_surface) keep_surface(chosen, sets);
  return sets;
}

}  // namespace

ListedBody make_file_body(const MeshFile& file, const FileBodyRequest& request, std::vector<std::int32_t>* file_nodes) {
  const int dimension = wanted_dimension(file, request);
  ChosenCells chosen = choose_cells(file, request, dimension);
  if (chosen.elements.size() == 0) throw InputError(request.place, fmt::format("{} has no elements for body \"{}\"", file.path, request.name));
  require_flat(file, request, chosen);
  BodySets sets = sets_of(file, request, chosen, dimension);
  ListedBody body;
  body.dimension = request.dimension;
  body.nodes = chosen.nodes();
  if (chosen.turned_count > 0)
    body.notes.push_back(
        fmt::format("the nodes of {} of {} elements ran clockwise and were turned round", chosen.turned_count, chosen.elements.size()));
  body.notes.insert(body.notes.end(), chosen.notes.begin(), chosen.notes.end());
  body.notes.insert(body.notes.end(), sets.notes.begin(), sets.notes.end());
  body.left_out = file.left_out;
  body.warnings = std::move(sets.warnings);
  body.side_names = std::move(sets.side_names);
  body.node_set_names = std::move(sets.node_set_names);
  fill_coordinates(body, file, request, chosen);
  fill_rows(body.node_sets_of_node, body.nodes, sets.set_of_node);
  fill_elements(body, std::move(chosen.elements), sets.sides);
  if (file_nodes != nullptr) *file_nodes = std::move(chosen.file_nodes);
  return body;
}

}  // namespace mortise
