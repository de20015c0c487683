#pragma once
// Facets that each rank has to give to others.

#include <algorithm>
#include <array>

#include "mortise/core/error.hpp"
#include "mortise/core/types.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace mortise {

/// A facet as it travels between ranks.
struct FacetIds {
  std::array<GlobalOrdinal, most_side_nodes> nodes{};
  int count = 0;

  FacetIds() = default;
  explicit FacetIds(const SurfaceFacet& facet) : count(static_cast<int>(facet.size())) { std::copy(facet.begin(), facet.end(), nodes.begin()); }
  SurfaceFacet facet() const { return {nodes.begin(), nodes.begin() + count}; }
};

/// Collective. Throws InputError at `place` for
///   - facets with nodes that the model does not have;
///   - a slave facet that is not given on each rank that owns a node of it, is given on another, or twice;
///   - a master facet that is given more than once.
void refuse_misplaced_facets(const Map& owned_nodes, const SurfaceFacets& slave, const SurfaceFacets& master, const Place& place);

}  // namespace mortise
