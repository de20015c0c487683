#pragma once
// Slave facets that this rank integrates for others.

#include <functional>
#include <vector>

#include "distribution/facet_distribution.hpp"

namespace mortise {

/// A slave facet of other ranks in this rank's local nodes.
struct GuestFacet {
  Facet<LocalOrdinal> nodes;
  std::vector<std::size_t> normals;  ///< [nodes] numbers of their normals
  std::vector<Facet<LocalOrdinal>> candidates;
  FacetMultipliers multipliers;
  std::vector<int> receivers;
  bool at_kink = false;  ///< it has normals of its own
};

/// All of them, with the stencils of those normals that the rank does not have anyway: they are numbered behind SlaveSurface::stencils.
struct GuestFacets {
  std::vector<GuestFacet> facets;
  std::vector<NormalStencil> stencils;

  GuestFacets() = default;
  /// @param local  the local node of an id, a new one if there is none
  GuestFacets(const std::vector<TravellingFacet>& travellers, const SlaveSurface& slave, const std::function<LocalOrdinal(GlobalOrdinal)>& local);
};

}  // namespace mortise
