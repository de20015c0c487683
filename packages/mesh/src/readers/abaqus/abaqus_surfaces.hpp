#pragma once
// Sides of cells that surfaces of Abaqus name.

#include <vector>

#include "readers/abaqus/abaqus_model.hpp"

namespace mortise {

/// A side of a cell of a part.
struct AbaqusCellSide {
  std::int32_t cell = 0;  ///< its number in all groups of the part
  std::int32_t side = 0;  ///< of its shape, or the_cell_itself
};

/// The cells of one shape of a part that is placed: they follow one another in a group of the mesh.
struct AbaqusCells {
  const FileCells* group = nullptr;
  std::int32_t first = 0, count = 0;
  const std::vector<bool>* is_surface = nullptr;  ///< [count]
};

/// The sides that no other cell of the part has, of these of its cells. Cells of surfaces are their own sides. The part has the nodes `first_node` to
/// `first_node + nodes - 1` of the mesh.
std::vector<AbaqusCellSide> exterior_sides(const std::vector<AbaqusCells>& part, std::int32_t first_node, std::int32_t nodes,
                                           const std::vector<std::int32_t>& cells);

}  // namespace mortise
