#pragma once
// Reference cells: how many nodes, which sides.

#include <array>
#include <vector>

namespace mortise {

/// Shapes of elements; nodes of plane ones are numbered counterclockwise. Lines are what rigid bodies in the plane are made of: a line is its own
/// only side.
enum class CellShape { line2, triangle3, quadrilateral4 };

/// Topology of a reference cell.
struct CellTopology {
  int dimension;
  int nodes;
  /// sides[s]: the cell's nodes on side s, in the order that has the outward normal on the right of the direction of travel in 2D,
  /// n = (t_y, -t_x).
  std::vector<std::vector<int>> sides;
};

const CellTopology& topology(CellShape shape);

}  // namespace mortise
