#pragma once
// The pure description of a rigid body in 3D: its surface, cut into quadrilaterals.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mortise/mesh/cell_nodes.hpp"
#include "mortise/mesh/curve_complex.hpp"
#include "mortise/mesh/swept_complex.hpp"

namespace mortise {

/// Patches of quadrilaterals that share corners and edges. Nodes are numbered corners first, then the insides of edges and of patches; elements
/// patch by patch. Has the members of VolumeComplex that a mesh is built from.
class ShellComplex {
 public:
  /// Point (i, j) of a patch's grid; i runs from corner 0 to 1, j from corner 0 to 3.
  struct GridPoint {
    int patch = 0;
    std::array<int, 2> at{};
  };
  struct Patch {
    std::array<int, 4> corners{};  ///< counterclockwise, seen from outside the body
    std::array<int, 2> cells{};    ///< in the directions of i and j
    std::string side;              ///< the name of the side that it belongs to
  };
  /// Position of a grid point, before the placement. At a point that several patches share it is asked for one of them.
  using Position = std::function<SpatialPoint(const GridPoint&)>;

  /// Edges are known by their corners, which are numbered without gaps. Throws std::logic_error if patches that share an edge differ in its number of
  /// cells (an error of the generator).
  ShellComplex(std::vector<Patch> patches, Position position, SpatialPlacement placement);

  CellShape shape() const { return CellShape::quadrilateral4; }
  GlobalOrdinal node_count() const { return patch_nodes_.back(); }
  GlobalOrdinal element_count() const { return patch_cells_.back(); }
  const std::vector<std::string>& side_names() const { return side_names_; }

  SpatialPoint coordinate(GlobalOrdinal node) const { return placement_(position_(grid_points(node).front())); }
  CellNodes element_nodes(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;
  /// Ascending.
  std::vector<int> sides_of_node(GlobalOrdinal node) const;

 private:
  /// Numbers points of a patch's edge from its corner of lower number on.
  struct Edge {
    std::array<int, 2> corners{};  ///< ascending
    int cells = 0;
    std::vector<std::array<int, 2>> uses;  ///< patch, number of the edge in it
  };
  GlobalOrdinal node_at(const GridPoint& point) const;
  std::vector<GridPoint> grid_points(GlobalOrdinal node) const;
  GridPoint on_edge(int patch, int edge, int from_lower_corner) const;

  std::vector<Patch> patches_;
  Position position_;
  SpatialPlacement placement_;
  std::vector<Edge> edges_;
  std::vector<std::array<int, 4>> patch_edges_;                           ///< [patches]
  std::vector<std::vector<GridPoint>> corner_uses_;                       ///< [corners]
  std::vector<GlobalOrdinal> edge_nodes_, patch_nodes_, patch_cells_{0};  ///< first number of each, and the end
  std::vector<int> patch_sides_;                                          ///< [patches] index into side_names_
  std::vector<std::string> side_names_;
};

/// The surface that a curve sweeps, with the names of its sides; it has no ends. Bodies lie to the left of the curve. Nodes are graded by `layers`
/// along the sweep.
ShellComplex sweep_surface(const CurveComplex& curve, const Spacing& layers, const Sweep& sweep, const SpatialPlacement& placement);

}  // namespace mortise
