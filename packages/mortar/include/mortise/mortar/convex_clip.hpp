#pragma once
// The part that two convex polygons of a plane have in common.

#include <Eigen/Core>
#include <array>
#include <boost/container/static_vector.hpp>

namespace mortise {

using PlanePolygon = boost::container::static_vector<Eigen::Vector2d, 4>;

/// How a vertex of the common part moves with a node of the polygons: dv = slope dx. Nodes: the first polygon's, then the second's.
struct VertexPart {
  int node = 0;
  Eigen::Matrix2d slope;
};

/// A vertex of the common part: where two edges meet. Edge e of a polygon runs from its node e to the next; the second's edges are counted on from
/// the first's.
struct ClipVertex {
  Eigen::Vector2d position;
  std::array<int, 2> edges{};
};

using ClipPolygon = boost::container::static_vector<ClipVertex, 16>;

/// Sutherland and Hodgman's algorithm. Each vertex keeps the two edges it lies on, from which its derivatives follow.
/// Nodes of the first polygon nearer to an edge of the second than 1e-12 of the first's size lie on it: matching meshes cover one another once, and
/// edges that coincide are not intersected.
/// @param first   counterclockwise
/// @param second  clockwise (a facet that faces the first)
/// @return counterclockwise; fewer than 3 vertices: no common part
ClipPolygon clip_convex(const PlanePolygon& first, const PlanePolygon& second);

/// What a vertex depends on: a node on itself, the intersection v of the edges a b and l m, at their shares t and u, with w across l m:
///   dv = P ((1 - t) dx_a + t dx_b) + (I - P) ((1 - u) dx_l + u dx_m),   P = I - (b - a) w^T / (w . (b - a)).
boost::container::static_vector<VertexPart, 4> vertex_parts(const ClipVertex& vertex, const PlanePolygon& first, const PlanePolygon& second);

/// Twice the signed area of the triangle a b c.
inline double doubled_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

}  // namespace mortise
