#pragma once
// Parts of quadratic facets that linear ones lack: mid-side nodes, linear parts, and the basis of their functions that is nowhere negative.

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <vector>

#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// Number of corners of a facet with so many nodes: the first ones. The others are the mid-side nodes, in the order of the edges.
constexpr std::size_t facet_corners(int dimension, std::size_t nodes) { return dimension == 2 ? 2 : (nodes > 4 ? nodes / 2 : nodes); }

/// A linear facet on some nodes of a facet, by their places.
using FacetPart = boost::container::static_vector<int, 4>;

/// The linear facets that a facet is cut into: a linear one is its own only part. Two lines of a line of 3 nodes; four triangles of a triangle of 6;
/// of a quadrilateral of 8 four triangles at the corners, and the quadrilateral of the mid-side nodes.
const std::vector<FacetPart>& linear_parts(int dimension, std::size_t nodes);

/// Vectors at the nodes of a part.
template <class Vectors>
Vectors part_of(const Vectors& vectors, const FacetPart& part) {
  Vectors result;
  for (const int a : part) result.push_back(vectors[static_cast<std::size_t>(a)]);
  return result;
}

/// The integrals of a quadratic facet's shape functions over a part of it may be negative, those of corners even over the whole facet (-A/12 of 8
/// nodes, 0 of triangles). So multipliers are dual to, or are,
///   Ñ_corner = N_corner + a sum of N_middle of its edges,   Ñ_middle = (1 - 2 a) N_middle,
/// which have the sum 1 too. Lines and triangles, a = 1/4: Bernstein's polynomials, L_a^2 and 2 L_a L_b in barycentric coordinates;
/// quadrilaterals, a = 3/8: Ñ_corner = (1 + s)(1 + t)(2 + s + t) / 16, s and t growing towards the corner from -1 to 1. All are >= 0, and these a are
/// the least for which they are.
struct NonNegativeBasis {
  FacetMatrix of_shape;  ///< B in Ñ = B N
  FacetMatrix to_shape;  ///< B^-1
};

/// Null for linear facets, whose shape functions are >= 0.
const NonNegativeBasis* non_negative_basis(int dimension, std::size_t nodes);

/// The corners at the ends of the edge with the middle `node` (its place on the facet).
constexpr std::array<std::size_t, 2> ends_of_edge(std::size_t node, std::size_t corners) { return {node - corners, (node - corners + 1) % corners}; }

}  // namespace mortise
