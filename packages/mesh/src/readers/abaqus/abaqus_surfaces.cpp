#include "readers/abaqus/abaqus_surfaces.hpp"

#include <algorithm>
#include <array>

#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {
namespace {

/// The corners of a side in ascending order, -1 before them where there are fewer than four; and whose it is.
struct CornersOfSide {
  std::array<std::int32_t, 4> corners;
  AbaqusCellSide of;
  bool wanted;

  bool operator<(const CornersOfSide& other) const { return corners < other.corners; }
};

}  // namespace

std::vector<AbaqusCellSide> exterior_sides(const std::vector<AbaqusCells>& part, std::int32_t first_node, std::int32_t nodes_of_part,
                                           const std::vector<std::int32_t>& cells) {
  std::int32_t count = 0;
  for (const AbaqusCells& group : part) count += group.count;
  std::vector<bool> wanted(static_cast<std::size_t>(count)), near(static_cast<std::size_t>(nodes_of_part));
  for (const std::int32_t cell : cells) wanted[static_cast<std::size_t>(cell)] = true;
  const auto for_each_cell = [&](const auto& visit) {
    std::int32_t cell = 0;
    for (const AbaqusCells& group : part) {
      const CellTopology& shape = topology(group.group->shape);
      const std::int32_t* nodes = group.group->nodes.data() + std::ptrdiff_t{group.first} * shape.nodes;
      for (std::int32_t c = 0; c < group.count; ++c, ++cell, nodes += shape.nodes)
        visit(shape, cell, nodes, (*group.is_surface)[static_cast<std::size_t>(c)]);
    }
  };
  for_each_cell([&](const CellTopology& shape, std::int32_t cell, const std::int32_t* nodes, bool) {
    for (int n = 0; wanted[static_cast<std::size_t>(cell)] && n < shape.nodes; ++n) near[static_cast<std::size_t>(nodes[n] - first_node)] = true;
  });
  std::vector<AbaqusCellSide> exterior;
  std::vector<CornersOfSide> sides;
  // Only sides whose corners all belong to these cells can be theirs.
  for_each_cell([&](const CellTopology& shape, std::int32_t cell, const std::int32_t* nodes, bool is_surface) {
    const bool is_wanted = wanted[static_cast<std::size_t>(cell)];
    if (is_surface || shape.sides.empty()) {
      if (is_wanted) exterior.push_back({cell, the_cell_itself});
      return;
    }
    for (std::size_t s = 0; s < shape.sides.size(); ++s) {
      CornersOfSide side{{-1, -1, -1, -1}, {cell, static_cast<std::int32_t>(s)}, is_wanted};
      bool all_near = true;
      for (int n = 0; n < shape.sides[s].corners; ++n) {
        side.corners[static_cast<std::size_t>(n)] = nodes[shape.sides[s].nodes[static_cast<std::size_t>(n)]];
        all_near = all_near && near[static_cast<std::size_t>(side.corners[static_cast<std::size_t>(n)] - first_node)];
      }
      if (!all_near) continue;
      std::sort(side.corners.begin(), side.corners.end());
      sides.push_back(side);
    }
  });
  std::sort(sides.begin(), sides.end());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    for (end = begin + 1; end < sides.size() && !(sides[begin] < sides[end]); ++end) continue;
    if (end == begin + 1 && sides[begin].wanted) exterior.push_back(sides[begin].of);
  }
  std::sort(exterior.begin(), exterior.end(),
            [](const AbaqusCellSide& a, const AbaqusCellSide& b) { return a.cell != b.cell ? a.cell < b.cell : a.side < b.side; });
  return exterior;
}

}  // namespace mortise
