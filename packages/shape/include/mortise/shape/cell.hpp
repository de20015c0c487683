#pragma once
// Reference cells: how many nodes, which sides.

#include <vector>

namespace mortise {

/// Shapes of elements and of their sides. Corners come first, then mid-side nodes. Nodes of plane cells are numbered counterclockwise. Hexahedra have
/// the bottom's nodes counterclockwise seen from above, then the top's (edges: bottom, top, upright). Tetrahedra have the base's nodes
/// counterclockwise seen from the apex. Rigid bodies are made of lines in 2D, of triangles or quadrilaterals in 3D: such a cell is its own only side.
enum class CellShape { line2, line3, triangle3, triangle6, quadrilateral4, quadrilateral8, tetrahedron4, tetrahedron10, hexahedron8, hexahedron20 };

/// Topology of a reference cell.
struct CellTopology {
  int dimension;   ///< 1 for lines, 2 for plane cells, 3 for solids
  int nodes;       ///< corners and mid-side nodes
  int corners;     ///< the first nodes
  CellShape side;  ///< shape of every side; of lines: the line itself
  /// sides[s]: the cell's nodes on side s, in the order of the side's shape. In 2D the outward normal is on the right of the direction of travel, n =
  /// (t_y, -t_x); in 3D the corners run counterclockwise seen from outside.
  std::vector<std::vector<int>> sides;
};

/// Nodes and sides of a shape; one object for each, which lives for ever.
const CellTopology& topology(CellShape shape);

/// Highest number of nodes of a cell, and of a side.
inline constexpr int most_cell_nodes = 20, most_side_nodes = 8;

}  // namespace mortise
