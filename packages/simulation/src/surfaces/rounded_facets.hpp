#pragma once
// Linear facets that stand for a smooth surface, and that surface.

#include <vector>

#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// The sides of a set, each as a facet of the smooth surface through the nodes: mid-side nodes are lifted onto it. Where the surface has a corner,
/// and where facets are quadratic, they are as they are.
struct RoundedFacets {
  std::vector<FacetPlaces> facets;  ///< [sides of the set, owned ones and ghosts]
  double highest = 0.0;             ///< the largest lift outwards, over all ranks: of a convex surface
  double deepest = 0.0;             ///< the largest inwards, above 0: of a hollow one
  double arc() const { return highest > deepest ? highest : deepest; }
};

/// Collective.
RoundedFacets round_facets(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at);

/// The most by which a smooth surface through the nodes may leave the facets, over all ranks. Facets of length h with normals that differ by the
/// angle a at a node that they share leave at most h a / 8. Of lines of arcs that is the sagitta. Of quadratic facets the angle is of third order.
/// There it is the bubble that a quadrilateral of 8 nodes does not have, and four times what lines of 3 nodes leave. Corners count for nothing.
/// @param with_linear  of linear facets too; else these have 0
/// Collective.
double height_of_kinks(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at, bool with_linear);

/// Difference of the gap between the smooth surfaces and that between facets, as slave nodes see it. It is the mean over their facets with the
/// weights of gaps, along the facets' normals. 0 of other nodes.
/// @param dual  gaps are weighted by dual functions
/// @return [owned nodes]
/// Collective.
std::vector<double> gaps_of_round_surfaces(const Mesh& mesh, const SideSet& slave, const SideSet& master, const PlaceOfNode& at, bool dual);

}  // namespace mortise
