#pragma once
// The pure description of a 3D body: a plane body swept along a line or about an axis.

#include <array>
#include <optional>
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

using Sweep = std::variant<Extrusion, Revolution>;

/// Where a point of the plane is after a share of the sweep.
SpatialPoint swept(const Sweep& sweep, const Point& point, double share);

/// Layers of cells over the elements of a plane body: hexahedra over quadrilaterals; a wedge or three tetrahedra over a triangle. Nodes and elements
/// are numbered layer by layer, in the order of the plane body. The mid-side nodes of quadratic cells' upright edges make layers of their own. Has
/// the members of PatchComplex that a mesh is built from.
class SweptComplex {
 public:
  /// Shape of the plane elements below cells of this shape; none: a sweep makes no such cells.
  static std::optional<CellShape> profile_shape(CellShape shape);

  /// @param profile  of elements of profile_shape(shape); for a revolution every x is positive
  /// @param ends     names of the sides where the sweep starts and ends; different from those of the profile
  SweptComplex(CellShape shape, PatchComplex profile, Spacing layers, Sweep sweep, const std::array<std::string, 2>& ends,
               SpatialPlacement placement);

  CellShape shape() const { return shape_; }
  GlobalOrdinal node_count() const { return nodes_per_cell_layer() * layers_.cells() + profile_.node_count(); }
  GlobalOrdinal element_count() const { return profile_.element_count() * layers_.cells() * elements_per_cell(); }
  /// Those of the profile, then where the sweep starts and ends.
  const std::vector<std::string>& side_names() const { return side_names_; }

  SpatialPoint coordinate(GlobalOrdinal node) const;
  /// The body that is swept.
  const PatchComplex& profile() const { return profile_; }
  /// x of the point of the profile that a node lies over.
  double radius(GlobalOrdinal node) const;
  /// Half layers below a node.
  int level_of(GlobalOrdinal node) const { return find(node).level; }
  /// The node over the same point of the profile so many half layers up: as many modulo 2 as of `node`.
  GlobalOrdinal on_level(GlobalOrdinal node, int level) const;
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
  /// A node over one of the profile, or of middle_ if the level is odd. Levels count half layers.
  struct Node {
    GlobalOrdinal below;
    int level;
  };
  /// A corner over a corner of the profile's element.
  struct Corner {
    int below;
    int level;
  };
  using Corners = boost::container::static_vector<Corner, 8>;

  bool is_cut() const { return topology(shape_).corners == 4; }
  int elements_per_cell() const { return is_cut() ? 3 : 1; }
  GlobalOrdinal nodes_per_cell_layer() const { return profile_.node_count() + (middle_ ? middle_->node_count() : 0); }
  const PatchComplex& at_level(int level) const { return level % 2 == 0 ? profile_ : *middle_; }
  Cell cell_of(GlobalOrdinal element) const;
  Corners corners_of(const Cell& cell) const;
  GlobalOrdinal node_at(const Node& node) const;
  Node find(GlobalOrdinal node) const;

  CellShape shape_;
  PatchComplex profile_;
  std::optional<PatchComplex>
      middle_;  ///< the nodes half way up a layer: corners of hexahedra and wedges, all nodes of tetrahedra; none for linear cells
  Spacing layers_;
  Sweep sweep_;
  SpatialPlacement placement_;
  std::vector<std::string> side_names_;
};

}  // namespace mortise
