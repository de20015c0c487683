#pragma once
// The part that two convex polygons of a plane have in common.

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>
#include <optional>

namespace mortise {

/// Vertices of a triangle or quadrilateral in a plane, in their order around it.
using PlanePolygon = boost::container::static_vector<Eigen::Vector2d, 4>;

/// Motion of a vertex of the common part with a node of the polygons: dv = slope dx. Nodes: the first polygon's, then the second's.
struct VertexPart {
  int node = 0;           ///< of both polygons, counted on
  Eigen::Matrix2d slope;  ///< dv/dx of that node
};

/// A vertex of the common part: where two edges meet. Edge e of a polygon runs from its node e to the next; the second's edges are counted on from
/// the first's.
struct ClipVertex {
  Eigen::Vector2d position;    ///< on the plane
  std::array<int, 2> edges{};  ///< the two that meet
  bool second_leaves = true;   ///< counterclockwise the polygon leaves the vertex along edges[1], else it arrives along it
};

/// Vertices of the common part, counterclockwise.
using ClipPolygon = boost::container::static_vector<ClipVertex, 16>;

/// Sutherland and Hodgman's algorithm. Each vertex keeps the two edges it lies on, from which its derivatives follow. Edges of the two polygons that
/// lie within 1e-12 of the first's size of one another coincide: the first's stands for both. So matching meshes cover one another once. Elsewhere
/// vertices may stand at the same place, with the edges that meet there two by two.
/// @param first   counterclockwise
/// @param second  clockwise (a facet that faces the first)
/// @return counterclockwise; fewer than 3 vertices: no common part
ClipPolygon clip_convex(const PlanePolygon& first, const PlanePolygon& second);

/// Two edges a b and l m that cross: at a + t (b - a) = l + u (m - l).
struct EdgeCrossing {
  std::array<int, 2> first_nodes;   ///< {a, b}
  std::array<int, 2> second_nodes;  ///< {l, m}
  Eigen::Vector2d along;            ///< b - a
  Eigen::Vector2d other;            ///< m - l
  double t = 0.0;                   ///< along the first edge
  double u = 0.0;                   ///< along the second edge

  /// `other` turned by +90 degrees.
  Eigen::Vector2d across() const { return {-other.y(), other.x()}; }
  /// True if the sine of their angle is below 1e-3.
  bool nearly_parallel() const;
};

/// The node at which a vertex stands; none: its edges cross.
std::optional<int> vertex_node(const ClipVertex& vertex, const PlanePolygon& first, const PlanePolygon& second);
/// The edges at whose crossing a vertex stands that stands at no node.
EdgeCrossing edge_crossing(const ClipVertex& vertex, const PlanePolygon& first, const PlanePolygon& second);

/// Parts of the vertices on which a crossing v depends, with w = across():
///   dv = P ((1 - t) dx_a + t dx_b) + (I - P) ((1 - u) dx_l + u dx_m),   P = I - (b - a) w^T / (w . (b - a)).
std::array<VertexPart, 4> vertex_parts(const EdgeCrossing& crossing);

/// Twice the signed area of the triangle a b c.
inline double doubled_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace mortise
