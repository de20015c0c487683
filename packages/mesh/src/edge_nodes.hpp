#pragma once
// Which nodes of a quadratic cell lie in the middle of which edge.

#include <array>
#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// The corners between which each node beyond the corners lies, in the order of these nodes; empty for cells that have corners alone.
inline std::vector<std::array<int, 2>> find_edge_corners(CellShape shape) {
  const CellTopology& cell = topology(shape);
  std::vector<std::array<int, 2>> corners(cell.nodes - cell.corners);
  if (cell.dimension == 1) return corners.empty() ? corners : std::vector<std::array<int, 2>>{{0, 1}};
  for (const auto& side : cell.sides) {
    const CellTopology& of_side = topology(cell.side);
    // Mid-side nodes follow the side's corners, each after the one that its edge starts at.
    for (int a = of_side.corners; a < of_side.nodes; ++a) {
      const int start = a - of_side.corners;
      corners[side[a] - cell.corners] = {side[start], side[(start + 1) % of_side.corners]};
    }
  }
  return corners;
}

/// As found by find_edge_corners, kept for each shape.
inline const std::vector<std::array<int, 2>>& edge_corners(CellShape shape) {
  static const std::vector<std::vector<std::array<int, 2>>> all = [] {
    std::vector<std::vector<std::array<int, 2>>> shapes;
    for (int s = 0; s <= static_cast<int>(CellShape::hexahedron20); ++s) shapes.push_back(find_edge_corners(static_cast<CellShape>(s)));
    return shapes;
  }();
  return all[static_cast<int>(shape)];
}

}  // namespace mortise
