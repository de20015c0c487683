#pragma once
// Cells in the pure descriptions of bodies.

#include <boost/container/static_vector.hpp>

#include "mortise/core/types.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// Nodes of a cell, in the order of its shape.
using CellNodes = boost::container::static_vector<GlobalOrdinal, most_cell_nodes>;

/// In the place of a side's number: the element is a facet of a surface, and its side is what it is itself.
inline constexpr int the_cell_itself = -1;

/// A side of an element on the body's surface.
struct SurfaceSide {
  int side = 0;  ///< of the element, or the_cell_itself
  int name = 0;  ///< index into the side names of the body
};

}  // namespace mortise
