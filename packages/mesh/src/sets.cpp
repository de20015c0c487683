#include "mortise/mesh/sets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "mortise/core/names.hpp"

namespace mortise {
namespace {

template <class Sets>
const typename Sets::mapped_type& require(const Sets& sets, const Located<std::string>& name, const std::string& kind) {
  const auto found = sets.find(name.value);
  if (found != sets.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : sets) names.push_back(entry.first);
  const std::string hint = did_you_mean(name.value, names);
  throw InputError(name.place, fmt::format("there is no {0} set \"{1}\"{2} {3} {0} sets are: {4}", kind, name.value, hint.empty() ? ";" : hint,
                                           hint.empty() ? "the" : "The", fmt::join(names, ", ")));
}

/// Runs `select` on every rank; an error of any rank (a `where` that is not finite somewhere) surfaces on all.
template <class Select>
void collectively(const Communicator& comm, Select&& select) {
  std::vector<Diagnostic> diagnostics;
  try {
    select();
  } catch (const InputError& error) {
    diagnostics = error.diagnostics();
  }
  throw_if_any(comm, diagnostics);
}

void require_any(const Communicator& comm, LocalOrdinal owned, const Named<SetOptions>& set, const char* what) {
  const GlobalOrdinal local = owned;
  GlobalOrdinal total = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 1, &local, &total);
  if (total == 0)
    throw InputError(set.place,
                     fmt::format("set \"{}\" is empty: no {} of \"{}\" has {} > 0", set.name, what, set.value.of.value, set.value.where.source()));
}

/// Nodes of the sides, on every rank that has the node: the owner has all sides at a node and tells the others.
std::vector<LocalOrdinal> nodes_of_sides(const Mesh& mesh, const SideSet& set) {
  Vector owned(mesh.owned_nodes), local(mesh.local_nodes);
  {
    auto marks = owned.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const auto& side : set.sides)
      for (const LocalOrdinal node : mesh.side_nodes(side))
        if (node < mesh.owned_count()) marks(node, 0) = 1.0;
  }
  local.doImport(owned, Import(mesh.owned_nodes, mesh.local_nodes), Tpetra::INSERT);
  const auto marks = local.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<LocalOrdinal> nodes;
  for (LocalOrdinal n = 0; n < mesh.local_count(); ++n)
    if (marks(n, 0) != 0.0) nodes.push_back(n);
  return nodes;
}

}  // namespace

void SetOptions::describe(Parameters& parameters) {
  parameters.add("of", of, Says("the set it is taken from: \"body/side\", or \"body\" for all nodes of a body").required());
  parameters.add("where", where,
                 Says("expression of x, y and z; kept are nodes, or sides by their middle, where it is > 0 in the reference position"));
  parameters.add("kind", kind, {{"nodes", SetKind::nodes}, {"sides", SetKind::sides}}, Says("what the set is made of"));
}

const SideSet& require_side_set(const Mesh& mesh, const Located<std::string>& name) { return require(mesh.side_sets, name, "side"); }

const std::vector<LocalOrdinal>& require_node_set(const Mesh& mesh, const Located<std::string>& name) {
  return require(mesh.node_sets, name, "node");
}

void add_set(Mesh& mesh, const Named<SetOptions>& set) {
  const auto& [of, where, kind] = set.value;
  if (mesh.node_sets.count(set.name)) throw InputError(set.place, fmt::format("there is already a set named \"{}\"", set.name));
  if (kind == SetKind::nodes) {
    const auto& source = require_node_set(mesh, of);
    std::vector<LocalOrdinal> kept;
    collectively(*mesh.comm, [&, &where = where] {
      for (const LocalOrdinal node : source) {
        const auto& x = mesh.coordinates[node];
        if (where(0.0, x[0], x[1], x[2]) > 0.0) kept.push_back(node);
      }
    });
    const auto owned = std::lower_bound(kept.begin(), kept.end(), mesh.owned_count()) - kept.begin();
    require_any(*mesh.comm, static_cast<LocalOrdinal>(owned), set, "node");
    mesh.node_sets[set.name] = std::move(kept);
    return;
  }
  const auto& source = require_side_set(mesh, of);
  SideSet kept;
  collectively(*mesh.comm, [&, &where = where] {
    for (std::size_t s = 0; s < source.sides.size(); ++s) {
      const auto nodes = mesh.side_nodes(source.sides[s]);
      std::array<double, 3> middle{};
      for (const LocalOrdinal node : nodes)
        for (int i = 0; i < 3; ++i) middle[i] += mesh.coordinates[node][i] / static_cast<double>(nodes.size());
      if (!(where(0.0, middle[0], middle[1], middle[2]) > 0.0)) continue;
      kept.sides.push_back(source.sides[s]);
      if (static_cast<LocalOrdinal>(s) < source.owned) ++kept.owned;
    }
  });
  require_any(*mesh.comm, kept.owned, set, "side");
  mesh.node_sets[set.name] = nodes_of_sides(mesh, kept);
  mesh.side_sets[set.name] = std::move(kept);
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
