#pragma once
// Nodes on a surface whose facets are spread over the ranks.

#include <vector>

#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// Collective: for each owned node whether any rank has it in its `facets`.
std::vector<char> nodes_on_surface(const RCP<const Map>& owned_nodes, const SurfaceFacets& facets);

}  // namespace mortise
