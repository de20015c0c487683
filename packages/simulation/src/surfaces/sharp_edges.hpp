#pragma once
// Sharp convex edges of the surfaces of bodies in 3D.

#include <array>
#include <vector>

#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// A straight piece of an edge, by local nodes.
struct SharpEdge {
  std::array<LocalOrdinal, 2> ends;    ///< ascending by their ids
  std::array<LocalOrdinal, 2> beside;  ///< of each of its two facets a corner that is not on the edge
  LocalOrdinal block = 0;              ///< of an element beside it
};

/// A node with those that follow it along an edge.
struct EdgeNode {
  LocalOrdinal node;
  std::array<LocalOrdinal, 2> next{-1, -1};  ///< both -1: edges end there, or it is a corner of the edge
};

/// Edges of a surface on this rank.
struct SharpEdges {
  std::vector<SharpEdge> pieces;  ///< whose first end it owns: each on one rank
  std::vector<EdgeNode> nodes;    ///< that it owns
};

/// Edges of a body between two facets, one of them or both in `set`, whose reference normals differ by more than kink_angle where the surface is
/// convex. An edge of quadratic facets has two pieces.
SharpEdges sharp_edges(const Mesh& mesh, std::size_t body, const SideSet& set);

}  // namespace mortise
