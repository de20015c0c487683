#pragma once
// The element types of Exodus II.

#include <cstdint>
#include <string>
#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Meaning of Exodus' name of an element type and its number of nodes.
struct ExodusElementType {
  bool is_point = false;  ///< the rest says nothing then
  CellShape shape = CellShape::line2;
  std::vector<int> order;  ///< for each node of the shape its place in the file
  std::vector<int> sides;  ///< for each side of the file, from 0, the side of the shape, the_cell_itself or the_other_face
};

/// The type, where the cell has so many nodes in a space of this dimension; else why it is not read stands in `refusal`.
ExodusElementType exodus_element_type(const std::string& name, std::int64_t nodes, int dimension, std::string& refusal);

}  // namespace mortise
