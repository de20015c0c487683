#pragma once
// The pure description of a body of space: a plane body swept along a line or about an axis.

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "mortise/mesh/patch_complex.hpp"
#include "mortise/mesh/spatial_placement.hpp"

namespace mortise {

/// Along z from z = 0.
struct Extrusion {
  double length = 1.0;
};

/// About the y axis, from the x axis toward the z axis: (x, y) goes to (x cos(phi), y, x sin(phi)).
struct Revolution {
  double angle = 1.0;  ///< radians, in (0, 2 pi)
};

/// Layers of cells over the elements of a plane body: hexahedra over quadrilaterals; three tetrahedra in each prism over a triangle. Nodes and
/// elements are numbered layer by layer, in the order of the plane body. Has the members of PatchComplex that a mesh is built from.
class SweptComplex {
 public:
  using Sweep = std::variant<Extrusion, Revolution>;

  /// Shape of the plane elements below cells of this shape.
  static CellShape profile_shape(CellShape shape);

  /// @param profile  of elements of profile_shape(shape); for a revolution every x is positive
  /// @param ends     names of the sides where the sweep starts and ends; different from those of the profile
  SweptComplex(CellShape shape, PatchComplex profile, Spacing layers, Sweep sweep, const std::array<std::string, 2>& ends,
               SpatialPlacement placement);

  CellShape shape() const { return shape_; }
  GlobalOrdinal node_count() const { return profile_.node_count() * (layers_.cells() + 1); }
  GlobalOrdinal element_count() const { return profile_.element_count() * layers_.cells() * elements_per_cell(); }
  /// Those of the profile, then where the sweep starts and ends.
  const std::vector<std::string>& side_names() const { return side_names_; }

  SpatialPoint coordinate(GlobalOrdinal node) const;
  CellNodes element_nodes(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<int> sides_of_node(GlobalOrdinal node) const;

 private:
  /// The cell over an element of the profile that an element lies in, and which of its elements it is.
  struct Cell {
    GlobalOrdinal below;
    int layer, part;
  };
  /// A node over one of the profile.
  struct Corner {
    GlobalOrdinal below;
    int layer;
  };
  using Corners = boost::container::static_vector<Corner, most_cell_nodes>;

  int elements_per_cell() const { return shape_ == CellShape::tetrahedron4 ? 3 : 1; }
  Cell cell_of(GlobalOrdinal element) const;
  Corners corners_of(const Cell& cell) const;

  CellShape shape_;
  PatchComplex profile_;
  Spacing layers_;
  Sweep sweep_;
  SpatialPlacement placement_;
  std::vector<std::string> side_names_;
};

}  // namespace mortise
