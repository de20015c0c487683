#pragma once
// Numbers of the grid points inside an edge, a face or a block of a structured mesh.

#include <array>

#include "mortise/core/types.hpp"
#include "mortise/shape/cell.hpp"

namespace mortise {

/// The grid points inside a line, a rectangle or a cuboid of cells (none on its boundary) that are nodes of cells of a shape. Coordinates are
/// doubled: even ones are corners of cells, odd ones midpoints. First come the corners, then the points that are midpoints in the first direction
/// only, and so on; among each kind the first direction runs fastest. Nothing of the mesh's size is stored.
class Lattice {
 public:
  using Point = std::array<int, 3>;  ///< the first `dimension` entries count

  /// @param cells  number of cells in each of the `dimension` directions
  Lattice(CellShape shape, int dimension, const std::array<int, 3>& cells);

  GlobalOrdinal size() const { return first_[8]; }
  GlobalOrdinal index(const Point& point) const;
  Point point(GlobalOrdinal index) const;

 private:
  /// Number of points in direction d that are midpoints of cells, or corners.
  GlobalOrdinal points(int d, bool are_middles) const { return are_middles ? cells_[d] : cells_[d] - 1; }

  int dimension_;
  std::array<int, 3> cells_;
  std::array<GlobalOrdinal, 9> first_{};  ///< [kinds: bit d is set for midpoints in direction d] first index, and the end
};

}  // namespace mortise
