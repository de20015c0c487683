#include "distribution/guest_facets.hpp"

#include <algorithm>

namespace mortise {
namespace {

// Facets, and so columns, are in the same order as at the node's owner: the normal is the same to the last bit.
NormalStencil make_stencil(LocalOrdinal node, const TravellingFacet::Stencil& from, const std::function<LocalOrdinal(GlobalOrdinal)>& local) {
  NormalStencil stencil;
  stencil.node = node;
  stencil.projected = from.projected;
  for (const auto& tangents : from.facets) {
    stencil.facets.push_back({{}, tangents.slope});
    for (const GlobalOrdinal id : tangents.nodes) stencil.facets.back().nodes.push_back(local(id));
    for (const LocalOrdinal column : stencil.facets.back().nodes)
      if (std::find(stencil.columns.begin(), stencil.columns.end(), column) == stencil.columns.end()) stencil.columns.push_back(column);
  }
  return stencil;
}

}  // namespace

GuestFacets::GuestFacets(const std::vector<TravellingFacet>& travellers, const SlaveSurface& slave,
                         const std::function<LocalOrdinal(GlobalOrdinal)>& local) {
  std::map<LocalOrdinal, std::size_t> normal_of;
  for (const TravellingFacet& traveller : travellers) {
    GuestFacet& facet = facets.emplace_back();
    facet.multipliers = traveller.multipliers;
    facet.receivers = traveller.receivers;
    for (std::size_t a = 0; a < traveller.nodes.size(); ++a) {
      const LocalOrdinal node = local(traveller.nodes[a]);
      facet.nodes.push_back(node);
      const std::size_t next = slave.stencils.size() + stencils.size();
      if (!traveller.stencils[a].of_node) {
        facet.at_kink = true;
        facet.normals.push_back(next);
        stencils.push_back(make_stencil(node, traveller.stencils[a], local));
        continue;
      }
      if (static_cast<std::size_t>(node) < slave.nodes_with_normal) {
        facet.normals.push_back(static_cast<std::size_t>(node));
        continue;
      }
      const auto [normal, is_new] = normal_of.insert({node, next});
      if (is_new) stencils.push_back(make_stencil(node, traveller.stencils[a], local));
      facet.normals.push_back(normal->second);
    }
    for (const SurfaceFacet& candidate : traveller.candidates) {
      facet.candidates.emplace_back();
      for (const GlobalOrdinal node : candidate) facet.candidates.back().push_back(local(node));
    }
  }
}

}  // namespace mortise
