#pragma once
// The pure description of a rigid body in 2D: its surface, cut into lines.

#include "mortise/mesh/patch_complex.hpp"

namespace mortise {

/// Straight or circular edges that share corners, each cut into lines; the body lies to the left of each edge. Nodes are numbered corners first,
/// then the interiors of edges; elements (lines) edge by edge. Has the members of PatchComplex that a mesh is built from.
class CurveComplex {
 public:
  using Edge = PatchComplex::Edge;

  /// `names`: of the side that each edge belongs to.
  CurveComplex(std::vector<Point> corners, std::vector<Edge> edges, const std::vector<std::string>& names, Placement placement);

  /// Its edges, which join corners.
  const std::vector<Edge>& edges() const { return edges_; }
  int corner_count() const { return static_cast<int>(corners_.size()); }
  /// Point i of edge e, from 0 at its start, placed.
  Point on_edge(int e, int i) const;
  /// The name of the side that edge e belongs to.
  const std::string& side_of_edge(int e) const { return side_names_[edge_sides_[e]]; }

  CellShape shape() const { return CellShape::line2; }
  GlobalOrdinal node_count() const { return edge_nodes_.back(); }
  GlobalOrdinal element_count() const { return edge_cells_.back(); }
  const std::vector<std::string>& side_names() const { return side_names_; }

  Point coordinate(GlobalOrdinal node) const;
  /// The two nodes of a line.
  CellNodes element_nodes(GlobalOrdinal element) const;
  std::vector<GlobalOrdinal> elements_of_node(GlobalOrdinal node) const;
  std::vector<SurfaceSide> surface_sides(GlobalOrdinal element) const;
  std::vector<int> sides_of_node(GlobalOrdinal node) const;

 private:
  std::vector<Point> corners_;
  std::vector<Edge> edges_;
  Placement placement_;
  std::vector<int> edge_sides_;                         ///< [edges] index into side_names_
  std::vector<GlobalOrdinal> edge_nodes_, edge_cells_;  ///< first number of each, and the end
  std::vector<std::string> side_names_;
};

}  // namespace mortise
