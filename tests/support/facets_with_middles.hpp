#pragma once
// Quadratic facets from linear ones.

#include <map>
#include <utility>
#include <vector>

#include "mortise/shape/surface_facet.hpp"

namespace mortise::test {

/// Facets with a node in the middle of every edge, in the order of their shapes. edges[i]: the ends of the one in whose middle node `first` + i
/// stands.
struct FacetsWithMiddles {
  SurfaceFacets facets;
  std::vector<std::pair<GlobalOrdinal, GlobalOrdinal>> edges;
};

inline FacetsWithMiddles with_middles(const SurfaceFacets& facets, GlobalOrdinal first) {
  FacetsWithMiddles result;
  std::map<std::pair<GlobalOrdinal, GlobalOrdinal>, GlobalOrdinal> middles;
  for (const SurfaceFacet& facet : facets) {
    SurfaceFacet quadratic = facet;
    const std::size_t edges = facet.size() == 2 ? 1 : facet.size();
    for (std::size_t e = 0; e < edges; ++e) {
      const std::pair<GlobalOrdinal, GlobalOrdinal> edge = std::minmax(facet[e], facet[(e + 1) % facet.size()]);
      const auto [found, is_new] = middles.insert({edge, first + static_cast<GlobalOrdinal>(result.edges.size())});
      if (is_new) result.edges.push_back(edge);
      quadratic.push_back(found->second);
    }
    result.facets.push_back(quadratic);
  }
  return result;
}

}  // namespace mortise::test
