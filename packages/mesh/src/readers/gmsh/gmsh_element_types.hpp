#pragma once
// The element types of Gmsh.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Meaning of Gmsh's number of an element type.
struct GmshElementType {
  std::optional<CellShape> shape;  ///< none: a point
  int nodes = 1;
  int dimension = 0;
  std::vector<int> order;  ///< for each node of the shape its place in the file
};

/// The type of this number; null if it is not read.
const GmshElementType* gmsh_element_type(std::int64_t number);

/// Why the type of this number is not read, and what to do.
std::string why_gmsh_type_is_refused(std::int64_t number);

}  // namespace mortise
