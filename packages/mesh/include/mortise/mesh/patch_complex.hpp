#pragma once
// The pure description of a structured body: mapped quadrilateral patches that share corners and edges.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/mesh/cell_nodes.hpp"
#include "mortise/mesh/lattice.hpp"
#include "mortise/mesh/spacing.hpp"

namespace mortise {

/// A position in 2D.
using Point = std::array<double, 2>;

/// Rotation about the origin, then translation.
struct Placement {
  double rotation = 0.0;  ///< degrees, counterclockwise
  Point translation{};
  Point operator()(const Point& point) const;
};

class CurveComplex;

/// Corners, edges between them (straight or circular arcs) and patches that four edges bound, each filled by transfinite interpolation. Nodes are
/// numbered corners first, then the interiors of edges, then the interiors of patches; elements patch by patch. Both are functions of their number:
/// nothing of the size of the mesh is stored. Quadratic cells have their mid-side nodes on the arcs.
class PatchComplex {
 public:
  struct Edge {
    int start = 0, end = 0;         ///< corners
    Spacing spacing;                ///< from start to end
    std::optional<Point> center{};  ///< of the circular arc (less than half a turn) from start to end
    std::optional<double> sweep{};  ///< angle of the arc in radians; needed only if it is not less than half a turn
  };
  /// Four corners, counterclockwise, and the names of the sides from each to the next (empty: an inner edge).
  struct Patch {
    std::array<int, 4> corners{};
    std::array<std::string, 4> sides{};
  };
  /// Throws std::logic_error if a patch's edge is missing or opposite edges differ in their number of cells (an error of the generator).
  PatchComplex(CellShape shape, std::vector<Point> corners, std::vector<Edge> edges, std::vector<Patch> patches, Placement placement);

  CellShape shape() const { return shape_; }
  GlobalOrdinal node_count() const { return patch_nodes_.back(); }
  GlobalOrdinal element_count() const { return patch_cells_.back() * elements_per_cell(); }
  const std::vector<std::string>& side_names() const { return side_names_; }

  /// Position of a node.
  Point coordinate(GlobalOrdinal node) const;

  /// The same body in other cells.
  PatchComplex with_shape(CellShape shape) const { return PatchComplex(shape, corners_, edges_, patches_, placement_); }

  /// Nodes of an element: corners counterclockwise, then the mid-side nodes.
  CellNodes element_nodes(GlobalOrdinal element) const;

  /// The named sides alone, as a chain of lines: what is left of the body if it is rigid.
  CurveComplex surface() const;

  /// All elements that have the node, ascending.
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;

  /// Sides of an element on the body's surface.
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;

  /// Names (indices into side_names(), ascending) of the sides that a node lies on.
  std::vector<int> sides_of_node(GlobalOrdinal node) const;

 private:
  /// Point (i, j) of a patch's grid; i runs from corner 0 to 1, j from corner 0 to 3. Both are doubled: odd ones are midpoints (see Lattice).
  struct GridPoint {
    int patch, i, j;
  };
  using GridPoints = boost::container::static_vector<GridPoint, 4>;
  /// An edge as a side of a patch: bottom 0 -> 1, right 1 -> 2, top 3 -> 2, left 0 -> 3.
  struct EdgeUse {
    int edge;
    bool flipped;
  };
  struct PatchUse {
    int patch, slot;
  };

  bool is_cut() const { return topology(shape_).corners == 3; }
  int elements_per_cell() const { return is_cut() ? 2 : 1; }
  int cells_i(int patch) const { return edges_[uses_[patch][0].edge].spacing.cells(); }
  int cells_j(int patch) const { return edges_[uses_[patch][1].edge].spacing.cells(); }
  /// The cell that an element lies in: its first corner.
  GridPoint cell_of(GlobalOrdinal element) const;
  GridPoints corners_of(GlobalOrdinal element) const;
  GlobalOrdinal node_at(const GridPoint& point) const;
  std::vector<GridPoint> grid_points(GlobalOrdinal node) const;
  double edge_position(const EdgeUse& use, int index) const;
  Point edge_point(const EdgeUse& use, int index) const;

  CellShape shape_;
  std::vector<Point> corners_;
  std::vector<Edge> edges_;
  std::vector<Patch> patches_;
  Placement placement_;
  std::vector<std::array<EdgeUse, 4>> uses_;                           ///< [patches]
  std::vector<std::vector<PatchUse>> corner_patches_;                  ///< [corners] slot: which corner of the patch
  std::vector<std::vector<PatchUse>> edge_patches_;                    ///< [edges] slot: which side of the patch
  std::vector<std::array<int, 4>> patch_sides_;                        ///< [patches] index into side_names_, or -1
  std::vector<Lattice> edge_lattices_, patch_lattices_;                ///< the nodes inside each
  std::vector<GlobalOrdinal> edge_nodes_, patch_nodes_, patch_cells_;  ///< first number of each, and the end
  std::vector<std::string> side_names_;
};

/// Point `index` / 2 of an edge's spacing: a point for even ones, the middle of a cell for odd ones.
Point edge_point(const PatchComplex::Edge& edge, const std::vector<Point>& corners, int index);

}  // namespace mortise
