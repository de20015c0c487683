#include "listed/chosen_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "mortise/core/names.hpp"
#include "readers/file_cells.hpp"

namespace mortise {
namespace {

constexpr std::int8_t not_chosen = -1;

/// [groups][cells] numbers of parts; not_chosen.
using Membership = std::vector<std::vector<std::int8_t>>;

const FileSet<FileCellRange>& require_cells(const MeshFile& file, const std::string& name, const Place& place) {
  std::vector<std::string> known;
  for (const auto& set : file.cell_sets) {
    if (set.name == name) return set;
    known.push_back(set.name);
  }
  for (const LeftOutSet& set : file.left_out)
    if (set.name == name) throw InputError(place, fmt::format("\"{}\" of {} is left out: {}", name, file.path, set.reason));
  if (known.empty()) throw InputError(place, fmt::format("{} names no blocks of elements; please leave out \"{}\"", file.path, name));
  throw InputError(place, fmt::format("in {} {}", file.path, unknown_name("block", name, known)));
}

/// visit(group, cell) for each cell of a set that has so many dimensions.
template <class Visit>
void for_each_cell(const MeshFile& file, const FileSet<FileCellRange>& set, int dimension, const Visit& visit) {
  for (const FileCellRange& range : set.members) {
    if (topology(file.cells[static_cast<std::size_t>(range.group)].shape).dimension != dimension) continue;
    for (std::int32_t cell = range.first; cell < range.first + range.count; ++cell) visit(range.group, cell);
  }
}

Membership choose(const MeshFile& file, const FileBodyRequest& request, int dimension) {
  Membership part;
  for (const FileCells& cells : file.cells) {
    const bool all = request.blocks.empty() && topology(cells.shape).dimension == dimension;
    part.emplace_back(cells.labels.size(), static_cast<std::int8_t>(all ? 0 : not_chosen));
  }
  for (const std::string& block : request.blocks) {
    bool any = false;
    for_each_cell(file, require_cells(file, block, request.place), dimension, [&](std::int32_t group, std::int32_t cell) {
      part[static_cast<std::size_t>(group)][static_cast<std::size_t>(cell)] = 0;
      any = true;
    });
    if (!any)
      throw InputError(request.place, fmt::format("block \"{}\" of {} has no cells of {} dimension(s), which body \"{}\" needs", block, file.path,
                                                  dimension, request.name));
  }
  // Part 0 is what no name takes.
  if (request.parts.size() > 100)
    throw InputError(request.place, fmt::format("body \"{}\" names {} parts; allowed: 100", request.name, request.parts.size()));
  for (std::size_t p = 0; p < request.parts.size(); ++p) {
    const auto& [name, place] = request.parts[p];
    bool any = false;
    for_each_cell(file, require_cells(file, name, place), dimension, [&](std::int32_t group, std::int32_t cell) {
      std::int8_t& of_cell = part[static_cast<std::size_t>(group)][static_cast<std::size_t>(cell)];
      if (of_cell == not_chosen) return;
      if (of_cell > 0)
        throw InputError(place, fmt::format("element {} of {} is in \"{}\" and in \"{}\"; a part with a material of its own must not overlap another",
                                            file.cells[static_cast<std::size_t>(group)].labels[static_cast<std::size_t>(cell)], file.path,
                                            request.parts[static_cast<std::size_t>(of_cell) - 1].value, name));
      of_cell = static_cast<std::int8_t>(p + 1);
      any = true;
    });
    if (!any) throw InputError(place, fmt::format("no element of body \"{}\" is in \"{}\" of {}", request.name, name, file.path));
  }
  return part;
}

std::vector<std::int32_t> used_nodes(const MeshFile& file, const Membership& part) {
  std::vector<char> is_used(file.coordinates.size(), 0);
  for (std::size_t group = 0; group < part.size(); ++group) {
    const auto per_cell = static_cast<std::size_t>(topology(file.cells[group].shape).nodes);
    for (std::size_t cell = 0; cell < part[group].size(); ++cell)
      if (part[group][cell] != not_chosen)
        for (std::size_t a = 0; a < per_cell; ++a) is_used[static_cast<std::size_t>(file.cells[group].nodes[per_cell * cell + a])] = 1;
  }
  std::vector<std::int32_t> nodes;
  for (std::size_t node = 0; node < is_used.size(); ++node)
    if (is_used[node]) nodes.push_back(static_cast<std::int32_t>(node));
  return nodes;
}

/// The area of the polygon of the corners, positive if they run counterclockwise: sum of x_a y_b - x_b y_a over its edges, halved.
double plane_area(const MeshFile& file, const std::int32_t* nodes, int corners) {
  double twice = 0.0;
  for (int a = 0; a < corners; ++a) {
    const auto &x = file.coordinates[static_cast<std::size_t>(nodes[a])], &y = file.coordinates[static_cast<std::size_t>(nodes[(a + 1) % corners])];
    twice += x[0] * y[1] - y[0] * x[1];
  }
  return 0.5 * twice;
}

}  // namespace

namespace {

/// The elements and nodes of cells that are in parts.
ChosenCells make_elements(const MeshFile& file, const FileBodyRequest& request, const Membership& part, bool mends) {
  ChosenCells chosen;
  chosen.file_nodes = used_nodes(file, part);
  std::vector<std::int32_t> number(file.coordinates.size(), -1);
  for (std::size_t node = 0; node < chosen.file_nodes.size(); ++node)
    number[static_cast<std::size_t>(chosen.file_nodes[node])] = static_cast<std::int32_t>(node);
  for (const auto& cells : part) chosen.elements_of_cells.emplace_back(cells.size(), -1);
  chosen.turned.resize(part.size());
  BodyElements& elements = chosen.elements;
  for (std::size_t p = 0; p <= request.parts.size(); ++p)
    for (std::size_t group = 0; group < part.size(); ++group) {
      const FileCells& cells = file.cells[group];
      const CellTopology& cell = topology(cells.shape);
      BodyPart added{p == 0 ? "" : request.parts[p - 1].value, cells.shape, 0};
      for (std::size_t c = 0; c < part[group].size(); ++c) {
        if (part[group][c] != static_cast<std::int8_t>(p)) continue;
        const std::int32_t* nodes = cells.nodes.data() + static_cast<std::size_t>(cell.nodes) * c;
        std::vector<std::int32_t> in_order(nodes, nodes + cell.nodes);
        if (mends && plane_area(file, nodes, cell.corners) < 0.0) {
          in_order = turned_round(nodes, cell);
          chosen.turned[group].resize(part[group].size(), 0);
          chosen.turned[group][c] = 1;
          ++chosen.turned_count;
        }
        for (const std::int32_t node : in_order) elements.nodes.push_back(number[static_cast<std::size_t>(node)]);
        elements.offsets.push_back(static_cast<std::int64_t>(elements.nodes.size()));
        chosen.elements_of_cells[group][c] = elements.size();
        elements.labels.push_back(cells.labels[c]);
        ++added.elements;
      }
      if (added.elements > 0) elements.parts.push_back(added);
    }
  return chosen;
}

/// Takes cells out that do not hang together with the node nearest to request.piece.
void keep_piece(const MeshFile& file, const FileBodyRequest& request, const ChosenCells& chosen, Membership& part) {
  const std::vector<std::int32_t> lowest = lowest_connected_nodes(chosen);
  double least = std::numeric_limits<double>::max();
  std::int32_t wanted = 0;
  for (std::size_t node = 0; node < lowest.size(); ++node) {
    const auto& x = file.coordinates[static_cast<std::size_t>(chosen.file_nodes[node])];
    double squared = 0.0;
    for (std::size_t i = 0; i < request.piece.size(); ++i) squared += (x[i] - request.piece[i]) * (x[i] - request.piece[i]);
    if (squared < least) least = squared, wanted = lowest[node];
  }
  for (std::size_t group = 0; group < part.size(); ++group)
    for (std::size_t cell = 0; cell < part[group].size(); ++cell)
      if (const std::int32_t element = chosen.elements_of_cells[group][cell];
          element >= 0 && lowest[static_cast<std::size_t>(*chosen.elements.nodes_of(element))] != wanted)
        part[group][cell] = not_chosen;
}

/// A facet has one outside, that along its normal. A rigid surface may be named by its other face: then its facets are turned, with all that hang
/// together with them.
void turn_facets(const MeshFile& file, const FileBodyRequest& request, ChosenCells& chosen) {
  struct Named {
    std::string along, against;  ///< a set that names a face of a piece along its normal, or against it
  };
  std::map<std::int32_t, Named> pieces;  // by lowest node
  const std::vector<std::int32_t> lowest = lowest_connected_nodes(chosen);
  BodyElements& elements = chosen.elements;
  const auto piece_of = [&](std::int32_t element) { return lowest[static_cast<std::size_t>(*elements.nodes_of(element))]; };
  for (const auto& set : file.side_sets)
    for (const FileSide& side : set.members) {
      if (side.side >= 0) continue;
      const std::int32_t element = chosen.elements_of_cells[static_cast<std::size_t>(side.group)][static_cast<std::size_t>(side.cell)];
      if (element < 0) continue;
      Named& named = pieces[piece_of(element)];
      (side.side == the_other_face ? named.against : named.along) = set.name;
    }
  for (const auto& [piece, named] : pieces)
    if (!named.against.empty() && !named.along.empty())
      chosen.notes.push_back(fmt::format("sets \"{}\" and \"{}\" name both faces of a surface of body \"{}\"; its outside is that along the normals",
                                         named.along, named.against, request.name));
  std::int64_t turned = 0;
  for (std::int32_t e = 0; e < elements.size(); ++e) {
    const auto found = pieces.find(piece_of(e));
    if (found == pieces.end() || found->second.against.empty() || !found->second.along.empty()) continue;
    const auto nodes = turned_round(elements.nodes_of(e), elements.cell(e));
    std::copy(nodes.begin(), nodes.end(), elements.nodes.begin() + elements.offsets[static_cast<std::size_t>(e)]);
    ++turned;
  }
  if (turned > 0) chosen.notes.push_back(fmt::format("{} of {} facets were turned, as sets of sides name their other face", turned, elements.size()));
}

}  // namespace

std::vector<std::int32_t> lowest_connected_nodes(const ChosenCells& chosen) {
  std::vector<std::int32_t> parent(chosen.file_nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t node) {
    while (parent[static_cast<std::size_t>(node)] != node) {
      std::int32_t& up = parent[static_cast<std::size_t>(node)];
      up = parent[static_cast<std::size_t>(up)];
      node = up;
    }
    return node;
  };
  const BodyElements& elements = chosen.elements;
  for (std::int32_t e = 0; e < elements.size(); ++e)
    for (auto n = elements.offsets[static_cast<std::size_t>(e)]; n < elements.offsets[static_cast<std::size_t>(e) + 1]; ++n) {
      const std::int32_t one = root(*elements.nodes_of(e)), other = root(elements.nodes[static_cast<std::size_t>(n)]);
      parent[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  for (std::size_t node = 0; node < parent.size(); ++node) parent[node] = root(static_cast<std::int32_t>(node));
  return parent;
}

ChosenCells choose_cells(const MeshFile& file, const FileBodyRequest& request, int cell_dimension) {
  Membership part = choose(file, request, cell_dimension);
  const bool mends = cell_dimension == 2 && request.dimension == 2;
  ChosenCells chosen = make_elements(file, request, part, mends);
  if (!request.piece.empty() && chosen.elements.size() > 0) {
    keep_piece(file, request, chosen, part);
    chosen = make_elements(file, request, part, mends);
  }
  if (cell_dimension < request.dimension) turn_facets(file, request, chosen);
  return chosen;
}

}  // namespace mortise
