#pragma once
// Cells of a reflected body: their nodes run the other way round.

#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// A cell that was reflected, as a cell of positive volume again.
struct ReflectedCell {
  std::vector<int> nodes;  ///< [nodes] the reflected cell's node a is node nodes[a] of the cell as it was
  std::vector<int> sides;  ///< [sides] side s of the cell as it was is side sides[s] of the reflected one
};

/// One constant object for each shape.
const ReflectedCell& reflected_cell(CellShape shape);

}  // namespace mortise
