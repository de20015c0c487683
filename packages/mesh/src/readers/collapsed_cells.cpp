#include "readers/collapsed_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "readers/file_cells.hpp"

namespace mortise {
namespace {

using Cycle = std::vector<int>;

/// For each node of a cell the first that is the same.
using Pattern = std::vector<int>;

/// Rest of a cell with a pattern.
struct Collapsed {
  CellShape shape = CellShape::triangle3;
  std::vector<int> nodes;  ///< [nodes of the shape] their places in the cell
  std::vector<int> sides;  ///< [sides of the cell] the side of the shape; -1: none
};

Pattern pattern_of(const std::int32_t* nodes, int count) {
  Pattern pattern(static_cast<std::size_t>(count));
  for (int a = 0; a < count; ++a) pattern[static_cast<std::size_t>(a)] = static_cast<int>(std::find(nodes, nodes + a, nodes[a]) - nodes);
  return pattern;
}

bool has_corner_twice(const std::int32_t* nodes, int corners) {
  for (int a = 1; a < corners; ++a)
    if (std::find(nodes, nodes + a, nodes[a]) != nodes + a) return true;
  return false;
}

/// Begins with its least corner.
Cycle in_canonical_order(Cycle corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// The corners that are left of a side of the cell, once each. Empty: it is no side any more.
Cycle collapsed_side(const CellTopology& cell, const CellSide& side, const Pattern& pattern) {
  Cycle corners;
  for (int n = 0; n < side.corners; ++n) {
    const int corner = pattern[static_cast<std::size_t>(side.nodes[static_cast<std::size_t>(n)])];
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  }
  if (cell.dimension == 3)
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < static_cast<std::size_t>(cell.dimension)) return {};
  return cell.dimension == 3 ? in_canonical_order(corners) : corners;
}

/// Places of mid-side nodes: of each edge of the shape the one of the cell's edges between the same corners. Nothing where two of these have
/// different nodes, or where an edge without length has a node of its own.
bool add_mid_side_nodes(const CellTopology& cell, const CellTopology& shape, const Pattern& pattern, std::vector<int>& nodes) {
  std::map<std::array<int, 2>, int> mid_sides;
  for (int k = 0; k < cell.mid_side_nodes(); ++k) {
    std::array<int, 2> ends{pattern[static_cast<std::size_t>(cell.edges[static_cast<std::size_t>(k)][0])],
                            pattern[static_cast<std::size_t>(cell.edges[static_cast<std::size_t>(k)][1])]};
    std::sort(ends.begin(), ends.end());
    const int node = pattern[static_cast<std::size_t>(cell.corners + k)];
    if (ends[0] == ends[1] ? node != ends[0] : node != cell.corners + k && mid_sides.count(ends) == 0) return false;
    if (ends[0] != ends[1] && mid_sides.emplace(ends, node).first->second != node) return false;
  }
  for (int k = 0; k < shape.mid_side_nodes(); ++k) {
    std::array<int, 2> ends{nodes[static_cast<std::size_t>(shape.edges[static_cast<std::size_t>(k)][0])],
                            nodes[static_cast<std::size_t>(shape.edges[static_cast<std::size_t>(k)][1])]};
    std::sort(ends.begin(), ends.end());
    const auto found = mid_sides.find(ends);
    if (found == mid_sides.end()) return false;
    nodes.push_back(found->second);
  }
  return true;
}

/// The cell as one of this shape: its corners are put in each order until all sides are those that are left, with their outsides outside.
std::optional<Collapsed> collapsed_to(CellShape to, const CellTopology& cell, const Pattern& pattern, std::vector<int> corners) {
  const CellTopology& shape = topology(to);
  if (static_cast<int>(corners.size()) != shape.corners || (cell.nodes == cell.corners) != (shape.nodes == shape.corners)) return std::nullopt;
  std::map<Cycle, int> left;  // sides of the cell by their corners
  std::size_t sides = 0;
  for (const CellSide& side : cell.sides)
    if (const Cycle of = collapsed_side(cell, side, pattern); !of.empty()) {
      left.emplace(of, -1);
      ++sides;
    }
  if (left.size() != sides || sides != shape.sides.size()) return std::nullopt;
  std::sort(corners.begin(), corners.end());
  do {
    std::size_t fit = 0;
    for (; fit < shape.sides.size(); ++fit) {
      Cycle of;
      for (int n = 0; n < shape.sides[fit].corners; ++n)
        of.push_back(corners[static_cast<std::size_t>(shape.sides[fit].nodes[static_cast<std::size_t>(n)])]);
      const auto found = left.find(cell.dimension == 3 ? in_canonical_order(of) : of);
      if (found == left.end()) break;
      found->second = static_cast<int>(fit);
    }
    if (fit < shape.sides.size()) continue;
    Collapsed collapsed{to, corners, {}};
    if (!add_mid_side_nodes(cell, shape, pattern, collapsed.nodes)) return std::nullopt;
    for (const CellSide& side : cell.sides) {
      const Cycle of = collapsed_side(cell, side, pattern);
      collapsed.sides.push_back(of.empty() ? -1 : left.at(of));
    }
    return collapsed;
  } while (std::next_permutation(corners.begin(), corners.end()));
  return std::nullopt;
}

std::optional<Collapsed> collapsed(const CellTopology& cell, const Pattern& pattern) {
  std::vector<int> corners(pattern.begin(), pattern.begin() + cell.corners);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const CellShape shape : {CellShape::triangle3, CellShape::triangle6, CellShape::wedge6, CellShape::wedge15, CellShape::pyramid5,
                                CellShape::tetrahedron4, CellShape::tetrahedron10})
    if (topology(shape).dimension == cell.dimension)
      if (auto found = collapsed_to(shape, cell, pattern, corners)) return found;
  return std::nullopt;
}

const char* name_of(CellShape shape) {
  const CellTopology& cell = topology(shape);
  if (cell.dimension == 2) return cell.corners == 3 ? "triangles" : "quadrilaterals";
  return cell.corners == 4 ? "tetrahedra" : cell.corners == 5 ? "pyramids" : cell.corners == 6 ? "wedges" : "hexahedra";
}

/// Takes collapsed cells out of their groups, and remembers where all cells are then.
class Replacement {
 public:
  explicit Replacement(MeshFile& file) : file_(file) {
    const std::size_t groups = file.cells.size();
    for (std::size_t g = 0; g < groups; ++g) replace_in(g);
  }

  bool any() const { return !counts_.empty(); }

  void move_sets() {
    for (auto& set : file_.cell_sets) {
      std::vector<FileCellRange> ranges;
      for (const FileCellRange& range : set.members)
        for (std::int32_t c = range.first; c < range.first + range.count; ++c) {
          const auto [group, cell] = place(range.group, c);
          add_cells(ranges, {group, cell, 1});
        }
      join_ranges(ranges);
      set.members = std::move(ranges);
    }
    std::int64_t left_out = 0;
    for (auto& set : file_.side_sets) {
      std::vector<FileSide> sides;
      for (const FileSide& side : set.members) {
        const auto [group, cell] = place(side.group, side.cell);
        const Collapsed* const now = collapsed_of(side.group, side.cell);
        const int number = side.side < 0 || now == nullptr ? side.side : now->sides[static_cast<std::size_t>(side.side)];
        if (now != nullptr && side.side >= 0 && number < 0)
          ++left_out;
        else
          sides.push_back({group, cell, number});
      }
      set.members = std::move(sides);
    }
    for (const auto& [shapes, count] : counts_)
      file_.notes.push_back(fmt::format("{} {} have corners that stand twice: they are {}", count, name_of(shapes.first), name_of(shapes.second)));
    if (left_out > 0) file_.notes.push_back(fmt::format("{} sides of sets are left out, as nothing but an edge is left of them", left_out));
  }

 private:
  struct Place {
    std::int32_t group, cell;
  };

  void replace_in(std::size_t g) {
    const CellShape was = file_.cells[g].shape;
    const CellTopology& cell = topology(was);
    const auto width = static_cast<std::size_t>(cell.nodes);
    std::map<Pattern, const Collapsed*> known;
    std::vector<std::int32_t> nodes;  // of the cells that stay
    std::vector<std::int64_t> labels;
    places_.emplace_back();
    const std::size_t count = file_.cells[g].labels.size();
    if (cell.corners < 4 || cell.dimension < 2) return;
    for (std::size_t c = 0; c < count; ++c) {
      const std::int32_t* const own = file_.cells[g].nodes.data() + width * c;
      const Collapsed* now = nullptr;
      if (has_corner_twice(own, cell.corners)) now = look_up(cell, pattern_of(own, cell.nodes), known);
      if (now != nullptr && places_[g].empty()) {  // the first one
        for (std::size_t before = 0; before < c; ++before) places_[g].push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(before)});
        collapsed_.resize(g + 1);
        collapsed_[g].assign(count, nullptr);
        nodes.assign(file_.cells[g].nodes.begin(), file_.cells[g].nodes.begin() + static_cast<std::ptrdiff_t>(width * c));
        labels.assign(file_.cells[g].labels.begin(), file_.cells[g].labels.begin() + static_cast<std::ptrdiff_t>(c));
      }
      if (now != nullptr) {
        const std::int64_t label = file_.cells[g].labels[c];
        const std::vector<std::int32_t> all(own, own + width);  // another group may be added
        const std::int32_t group = group_of(file_.cells, now->shape);
        FileCells& to = file_.cells[static_cast<std::size_t>(group)];
        places_[g].push_back({group, static_cast<std::int32_t>(to.labels.size())});
        for (const int node : now->nodes) to.nodes.push_back(all[static_cast<std::size_t>(node)]);
        to.labels.push_back(label);
        collapsed_[g][c] = now;
        ++counts_[{was, now->shape}];
      } else if (!places_[g].empty()) {
        places_[g].push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(labels.size())});
        nodes.insert(nodes.end(), own, own + width);
        labels.push_back(file_.cells[g].labels[c]);
      }
    }
    if (places_[g].empty()) return;
    file_.cells[g].nodes = std::move(nodes);
    file_.cells[g].labels = std::move(labels);
  }

  const Collapsed* look_up(const CellTopology& cell, const Pattern& pattern, std::map<Pattern, const Collapsed*>& known) {
    const auto [entry, added] = known.emplace(pattern, nullptr);
    if (added)
      if (auto found = collapsed(cell, pattern)) {
        shapes_.push_back(std::make_unique<Collapsed>(std::move(*found)));
        entry->second = shapes_.back().get();
      }
    return entry->second;
  }

  Place place(std::int32_t group, std::int32_t cell) const {
    const auto g = static_cast<std::size_t>(group);
    if (g >= places_.size() || places_[g].empty()) return {group, cell};
    const Place now = places_[g][static_cast<std::size_t>(cell)];
    return now.group > group ? place(now.group, now.cell) : now;  // cells were taken out of a later group when these had been added to it
  }

  const Collapsed* collapsed_of(std::int32_t group, std::int32_t cell) const {
    const auto g = static_cast<std::size_t>(group);
    return g >= collapsed_.size() || collapsed_[g].empty() ? nullptr : collapsed_[g][static_cast<std::size_t>(cell)];
  }

  MeshFile& file_;
  std::vector<std::vector<Place>> places_;                ///< [groups][cells] where they are now; empty: where they were
  std::vector<std::vector<const Collapsed*>> collapsed_;  ///< [groups][cells] null: it stays; empty: all do
  std::vector<std::unique_ptr<Collapsed>> shapes_;
  std::map<std::pair<CellShape, CellShape>, std::int64_t> counts_;
};

}  // namespace

void replace_collapsed_cells(MeshFile& file) {
  Replacement replacement(file);
  if (replacement.any()) replacement.move_sets();
}

}  // namespace mortise
