#include "slave_surface_2d.hpp"

#include <fmt/format.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "exchange.hpp"

namespace mortise {
namespace {

using FacetIds = std::array<GlobalOrdinal, 2>;
constexpr double no_free_normal = 0.1;  // share of the averaged normal that free directions keep, below which nothing can be pushed
constexpr double two_pi = 6.283185307179586476925286766559;

// All slave facets of nodes that belong to other ranks: their owners know them. Throws InputError for a node without owner.
std::vector<FacetIds> facets_of_foreign_nodes(const Map& owned_nodes, const std::vector<GlobalOrdinal>& foreign, const SurfaceFacets& facets,
                                              const Place& place) {
  const Communicator& comm = *owned_nodes.getComm();
  std::vector<int> owners(foreign.size());
  owned_nodes.getRemoteIndexList(Teuchos::arrayViewFromVector(foreign), Teuchos::arrayViewFromVector(owners));
  std::vector<Diagnostic> diagnostics;
  for (std::size_t n = 0; n < foreign.size(); ++n)
    if (owners[n] < 0) diagnostics.push_back({place, fmt::format("the slave surface names node {}, which the model does not have", foreign[n])});
  throw_if_any(comm, diagnostics);
  std::vector<std::vector<GlobalOrdinal>> ask(comm.getSize());
  for (std::size_t n = 0; n < foreign.size(); ++n) ask[owners[n]].push_back(foreign[n]);
  std::multimap<GlobalOrdinal, FacetIds> known;
  for (const SurfaceFacet& facet : facets)
    for (const GlobalOrdinal node : facet) known.insert({node, {facet[0], facet[1]}});
  std::vector<std::vector<FacetIds>> answer(comm.getSize());
  const auto asked = all_to_all(comm, ask);
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
    for (const GlobalOrdinal node : asked[rank])
      for (auto [one, end] = known.equal_range(node); one != end; ++one) answer[rank].push_back(one->second);
  std::set<FacetIds> all;
  for (const auto& part : all_to_all(comm, answer)) all.insert(part.begin(), part.end());
  return {all.begin(), all.end()};
}

// int N_j over a straight facet: t L / 2, or 2 pi L (r_j / 3 + r_k / 6).
std::array<double, 2> weights(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const InterfaceMeasure& measure) {
  const double length = (b - a).norm();
  if (!measure.axisymmetric) return {0.5 * length * measure.thickness, 0.5 * length * measure.thickness};
  return {two_pi * length * (a.x() / 3.0 + b.x() / 6.0), two_pi * length * (a.x() / 6.0 + b.x() / 3.0)};
}

}  // namespace

SlaveSurface2d make_slave_surface_2d(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const RCP<const MultiVector>& fixed,
                                     const SurfaceFacets& facets, const InterfaceMeasure& measure, const Place& place) {
  SlaveSurface2d surface;
  std::set<GlobalOrdinal> on_facets;
  for (const SurfaceFacet& facet : facets) on_facets.insert(facet.begin(), facet.end());
  std::vector<std::pair<LocalOrdinal, GlobalOrdinal>> owned;
  std::vector<GlobalOrdinal> foreign;
  for (const GlobalOrdinal node : on_facets) {
    const LocalOrdinal local = owned_nodes->getLocalElement(node);
    if (local >= 0)
      owned.push_back({local, node});
    else
      foreign.push_back(node);
  }
  std::sort(owned.begin(), owned.end());
  for (const auto& [local, node] : owned) surface.node_ids.push_back(node);
  surface.node_ids.insert(surface.node_ids.end(), foreign.begin(), foreign.end());
  surface.nodes_with_normal = surface.node_ids.size();

  std::set<FacetIds> all_facets;
  for (const SurfaceFacet& facet : facets) all_facets.insert({facet[0], facet[1]});
  for (const FacetIds& facet : facets_of_foreign_nodes(*owned_nodes, foreign, facets, place)) all_facets.insert(facet);
  std::map<GlobalOrdinal, LocalOrdinal> local_of;
  for (std::size_t n = 0; n < surface.node_ids.size(); ++n) local_of[surface.node_ids[n]] = static_cast<LocalOrdinal>(n);
  for (const FacetIds& facet : all_facets)
    for (const GlobalOrdinal node : facet)
      if (local_of.insert({node, static_cast<LocalOrdinal>(surface.node_ids.size())}).second) surface.node_ids.push_back(node);

  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, surface.node_ids.data(), static_cast<LocalOrdinal>(surface.node_ids.size()), 0, owned_nodes->getComm()));
  const Import import(owned_nodes, map);
  MultiVector X(map, 2), F(map, 2);
  X.doImport(*reference, import, Tpetra::REPLACE);
  F.doImport(*fixed, import, Tpetra::REPLACE);
  const auto X_view = X.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto F_view = F.getLocalViewHost(Tpetra::Access::ReadOnly);
  Positions x(surface.node_ids.size());
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = {X_view(n, 0), X_view(n, 1)};

  surface.stencils.resize(surface.nodes_with_normal);
  for (const FacetIds& ids : all_facets) {
    const std::array<LocalOrdinal, 2> facet = {local_of[ids[0]], local_of[ids[1]]};
    for (const LocalOrdinal node : facet) {
      if (static_cast<std::size_t>(node) >= surface.nodes_with_normal) continue;
      NormalStencil& stencil = surface.stencils[node];
      stencil.facets.push_back(facet);
      for (const LocalOrdinal one : facet)
        if (std::find(stencil.columns.begin(), stencil.columns.end(), one) == stencil.columns.end()) stencil.columns.push_back(one);
    }
  }

  std::vector<Diagnostic> diagnostics;
  surface.carries.assign(surface.nodes_with_normal, 1);
  for (std::size_t n = 0; n < surface.nodes_with_normal; ++n) {
    NodalNormal normal;
    if (!average_normal(surface.stencils[n], x, false, normal)) {
      diagnostics.push_back(
          {place, fmt::format("the slave surface has no normal at node {} ({}, {}): a facet without length, or facets folded onto one another",
                              surface.node_ids[n], x[n].x(), x[n].y())});
      continue;
    }
    const std::array<bool, 2> is_fixed = {F_view(n, 0) != 0.0, F_view(n, 1) != 0.0};
    SpatialVector free = normal.normal;
    for (int i = 0; i < 2; ++i)
      if (is_fixed[i]) free[i] = 0.0;
    surface.carries[n] = free.norm() >= no_free_normal;
    if (surface.carries[n]) surface.stencils[n].projected = is_fixed;
    if (n >= owned.size()) continue;
    SlaveNode node;
    node.id = surface.node_ids[n];
    node.owned_node = owned[n].first;
    node.local_node = static_cast<LocalOrdinal>(n);
    node.fixed = {is_fixed[0], is_fixed[1], false};
    node.carries_multiplier = surface.carries[n];
    surface.owned.push_back(node);
  }
  throw_if_any(*owned_nodes->getComm(), diagnostics);

  surface.facets_of.resize(surface.owned.size());
  for (const SurfaceFacet& ids : facets) {
    const std::array<LocalOrdinal, 2> facet = {local_of[ids[0]], local_of[ids[1]]};
    if (!surface.carries[facet[0]] && !surface.carries[facet[1]])
      diagnostics.push_back(
          {place, fmt::format("the slave facet between nodes {} ({}, {}) and {} ({}, {}) has prescribed displacements at all its nodes, so it "
                              "can carry no contact; please make this side the master",
                              ids[0], x[facet[0]].x(), x[facet[0]].y(), ids[1], x[facet[1]].x(), x[facet[1]].y())});
    const std::array<double, 2> weight = weights(x[facet[0]], x[facet[1]], measure);
    for (int j = 0; j < 2; ++j) {
      if (static_cast<std::size_t>(facet[j]) >= surface.owned.size()) continue;
      surface.owned[facet[j]].weight += weight[j];
      surface.facets_of[facet[j]].push_back(surface.facets.size());
    }
    surface.facets.push_back(facet);
    surface.facet_weights.push_back(weight);
  }
  throw_if_any(*owned_nodes->getComm(), diagnostics);
  return surface;
}

}  // namespace mortise
