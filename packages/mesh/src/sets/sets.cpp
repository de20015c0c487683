#include "mortise/mesh/sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Map.hpp>
#include <algorithm>

#include "mortise/core/names.hpp"

namespace mortise {
namespace {

template <class Sets>
const typename Sets::mapped_type& require(const Mesh& mesh, const Sets& sets, const Located<std::string>& name, const std::string& kind) {
  const auto found = sets.find(name.value);
  if (found != sets.end()) return found->second;
  if (const auto left_out = mesh.left_out_sets.find(name.value); left_out != mesh.left_out_sets.end())
    throw InputError(name.place, fmt::format("set \"{}\" of the mesh file is left out: {}", name.value, left_out->second));
  std::vector<std::string> names;
  for (const auto& entry : sets) names.push_back(entry.first);
  std::string hint = did_you_mean(name.value, names);
  if (kind == "side" && mesh.node_sets.count(name.value) > 0)
    hint = ", only a set of nodes of this name: a surface given by nodes, or one with sides between two elements, is none of sides.";
  throw InputError(name.place, fmt::format("there is no {0} set \"{1}\"{2} {3} {0} sets are: {4}", kind, name.value, hint.empty() ? ";" : hint,
                                           hint.empty() ? "the" : "The", fmt::join(names, ", ")));
}

}  // namespace

const SideSet& require_side_set(const Mesh& mesh, const Located<std::string>& name) { return require(mesh, mesh.side_sets, name, "side"); }

const std::vector<LocalOrdinal>& require_node_set(const Mesh& mesh, const Located<std::string>& name) {
  return require(mesh, mesh.node_sets, name, "node");
}

namespace {

SurfaceFacet facet_of(const Mesh& mesh, const std::vector<LocalOrdinal>& nodes) {
  SurfaceFacet facet;
  for (const LocalOrdinal node : nodes) facet.push_back(mesh.local_nodes->getGlobalElement(node));
  return facet;
}

}  // namespace

SurfaceFacets facets_at_owned_nodes(const Mesh& mesh, const SideSet& set) {
  SurfaceFacets facets;
  for (const auto& side : set.sides) {
    const auto nodes = mesh.side_nodes(side);
    if (std::any_of(nodes.begin(), nodes.end(), [&](LocalOrdinal n) { return n < mesh.owned_count(); })) facets.push_back(facet_of(mesh, nodes));
  }
  return facets;
}

SurfaceFacets facets_of_owned_elements(const Mesh& mesh, const SideSet& set) {
  SurfaceFacets facets;
  for (LocalOrdinal s = 0; s < set.owned; ++s) facets.push_back(facet_of(mesh, mesh.side_nodes(set.sides[s])));
  return facets;
}

}  // namespace mortise
