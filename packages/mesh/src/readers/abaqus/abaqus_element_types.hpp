#pragma once
// The element types of Abaqus and CalculiX.

#include <optional>
#include <string>
#include <vector>

#include "mortise/shape/cell.hpp"

namespace mortise {

/// Meaning of an element type here.
struct AbaqusElementType {
  std::optional<CellShape> shape;  ///< none: it is not read
  bool is_surface = false;         ///< a shell, membrane or rigid surface: it has two faces, which are itself
  bool is_left_out = false;        ///< it has no cell, as a spring; a mesh is whole without it
  std::string note;                ///< the element that replaces it, what it is, or the reason why it is not read; may be empty
};

/// The type of a name in capital letters.
AbaqusElementType abaqus_element_type(const std::string& name);

/// The side S1, S2, ... (`number` from 1) of a cell of this shape, or E1, ... of a plane one; -1 if it has none. Mid-side nodes make no difference.
int abaqus_side(CellShape shape, int number);

}  // namespace mortise
