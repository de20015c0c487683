#include "slave/slave_surface.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "exchange/exchange.hpp"
#include "mortise/mortar/auxiliary_plane.hpp"
#include "mortise/mortar/mortar_interface.hpp"
#include "slave/facet_placement.hpp"
#include "slave/held_facets.hpp"

namespace mortise {
namespace {

constexpr double follows_another = 2.0;  // in the marks of what is fixed
constexpr double no_free_normal = 0.1;   // share of the averaged normal that free directions keep, below which nothing can be pushed

// All slave facets of nodes that belong to other ranks: their owners know them.
std::vector<SurfaceFacet> facets_of_foreign_nodes(const Map& owned_nodes, const std::vector<GlobalOrdinal>& foreign, const SurfaceFacets& facets) {
  const Communicator& comm = *owned_nodes.getComm();
  std::vector<int> owners(foreign.size());
  owned_nodes.getRemoteIndexList(Teuchos::arrayViewFromVector(foreign), Teuchos::arrayViewFromVector(owners));
  std::vector<std::vector<GlobalOrdinal>> ask(comm.getSize());
  for (std::size_t n = 0; n < foreign.size(); ++n) ask[owners[n]].push_back(foreign[n]);
  std::multimap<GlobalOrdinal, FacetIds> known;
  for (const SurfaceFacet& facet : facets)
    for (const GlobalOrdinal node : facet) known.insert({node, FacetIds(facet)});
  std::vector<std::vector<FacetIds>> answer(comm.getSize());
  const auto asked = all_to_all(comm, ask);
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
    for (const GlobalOrdinal node : asked[rank])
      for (auto [one, end] = known.equal_range(node); one != end; ++one) answer[rank].push_back(one->second);
  std::set<SurfaceFacet> all;
  for (const auto& part : all_to_all(comm, answer))
    for (const FacetIds& ids : part) all.insert(ids.facet());
  return {all.begin(), all.end()};
}

template <int dim>
std::string written(const Eigen::Matrix<double, dim, 1>& x) {
  return fmt::format("({:g})", fmt::join(x.data(), x.data() + dim, ", "));
}

// "5 (0, 1) and 6 (1, 1)"
template <int dim>
std::string written(const SurfaceFacet& ids, const FacetPoints<dim>& x) {
  std::string text;
  for (std::size_t a = 0; a < ids.size(); ++a)
    text += fmt::format("{}{} {}", a == 0 ? "" : (a + 1 == ids.size() ? " and " : ", "), ids[a], written<dim>(x[a]));
  return text;
}

bool sound(const FacetPoints<2>&) { return true; }  // without length it has no normal
bool sound(const FacetPoints<3>& x) { return make_auxiliary_plane(x).has_value(); }

}  // namespace

bool SlaveSurface::may_load(int dimension, std::size_t facet, LocalOrdinal multiplier, LocalOrdinal node) const {
  const auto place = [&](LocalOrdinal one) { return std::find(facets[facet].begin(), facets[facet].end(), one) - facets[facet].begin(); };
  const auto share = multipliers[facet].share.row(place(multiplier));
  const NonNegativeBasis* basis = non_negative_basis(dimension, facets[facet].size());
  if (basis == nullptr) return share[place(node)] != 0.0;
  // D_jk = sum_i S_ji (int Ñ_i) (B^-1)_ki
  return share.cwiseProduct(basis->to_shape.row(place(node))).any();
}

template <int dim>
SlaveSurface make_slave_surface(const RCP<const Map>& owned_nodes, const RCP<const MultiVector>& reference, const RCP<const MultiVector>& fixed,
                                const SurfaceFacets& facets, const InterfaceMeasure& measure, const Place& place) {
  SlaveSurface surface;
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

  std::set<SurfaceFacet> all_facets(facets.begin(), facets.end());
  for (const SurfaceFacet& facet : facets_of_foreign_nodes(*owned_nodes, foreign, facets)) all_facets.insert(facet);
  std::map<GlobalOrdinal, LocalOrdinal> local_of;
  for (std::size_t n = 0; n < surface.node_ids.size(); ++n) local_of[surface.node_ids[n]] = static_cast<LocalOrdinal>(n);
  for (const SurfaceFacet& facet : all_facets)
    for (const GlobalOrdinal node : facet)
      if (local_of.insert({node, static_cast<LocalOrdinal>(surface.node_ids.size())}).second) surface.node_ids.push_back(node);

  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const auto map = rcp(new Map(invalid, surface.node_ids.data(), static_cast<LocalOrdinal>(surface.node_ids.size()), 0, owned_nodes->getComm()));
  const Import import(owned_nodes, map);
  MultiVector X(map, dim), F(map, dim);
  X.doImport(*reference, import, Tpetra::REPLACE);
  F.doImport(*fixed, import, Tpetra::REPLACE);
  const auto X_view = X.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto F_view = F.getLocalViewHost(Tpetra::Access::ReadOnly);
  const Positions<dim> x = positions_of<dim>(X_view);
  const auto local = [&](const SurfaceFacet& ids) {
    Facet<LocalOrdinal> facet;
    for (const GlobalOrdinal id : ids) facet.push_back(local_of[id]);
    return facet;
  };

  surface.stencils.resize(surface.nodes_with_normal);
  for (const SurfaceFacet& ids : all_facets) {
    const Facet<LocalOrdinal> facet = local(ids);
    for (std::size_t a = 0; a < facet.size(); ++a) {
      if (static_cast<std::size_t>(facet[a]) >= surface.nodes_with_normal) continue;
      NormalStencil& stencil = surface.stencils[facet[a]];
      stencil.node = facet[a];
      stencil.facets.push_back(tangents_at<dim>(facet, a));
      for (const LocalOrdinal node : stencil.facets.back().nodes)
        if (std::find(stencil.columns.begin(), stencil.columns.end(), node) == stencil.columns.end()) stencil.columns.push_back(node);
    }
  }

  std::vector<Diagnostic> diagnostics;
  surface.carries.assign(surface.nodes_with_normal, 1);
  for (std::size_t n = 0; n < surface.nodes_with_normal; ++n) {
    NodalNormal normal;
    if (!average_normal(surface.stencils[n], x, false, normal)) {
      diagnostics.push_back(
          {place, fmt::format("the slave surface has no normal at node {} {}: a facet without {}, or facets folded onto one another",
                              surface.node_ids[n], written<dim>(x[n]), dim == 2 ? "length" : "area")});
      continue;
    }
    std::array<bool, 3> is_fixed{};
    for (int i = 0; i < dim; ++i) is_fixed[i] = F_view(n, i) != 0.0;
    SpatialVector free = normal.normal;
    for (int i = 0; i < dim; ++i)
      if (is_fixed[i]) free[i] = 0.0;
    surface.carries[n] = free.norm() >= no_free_normal;
    if (surface.carries[n]) {
      // A facet that lies along the plane, as the side of a body that is held aside, has no mirror image: the average stays as it is.
      surface.stencils[n].projected = is_fixed;
      if (!average_normal(surface.stencils[n], x, false, normal)) surface.stencils[n].projected = {};
    }
    if (n >= owned.size()) continue;
    SlaveNode node;
    node.id = surface.node_ids[n];
    node.owned_node = owned[n].first;
    node.local_node = static_cast<LocalOrdinal>(n);
    node.fixed = is_fixed;
    node.carries_multiplier = surface.carries[n];
    surface.owned.push_back(node);
  }
  throw_if_any(*owned_nodes->getComm(), diagnostics);

  surface.facets_of.resize(surface.owned.size());
  HeldFacets held;
  for (const SurfaceFacet& ids : facets) {
    const Facet<LocalOrdinal> facet = local(ids);
    const FacetPoints<dim> points = points_of<dim>(facet, x);
    std::vector<char> carries;
    for (const LocalOrdinal node : facet) carries.push_back(surface.carries[node]);
    const std::size_t corners = facet_corners(dim, facet.size());
    const bool quadratic = facet.size() > corners;  // then the mid-side nodes carry what nodes without multiplier leave to others
    if (owned_nodes->isNodeGlobalElement(ids.front())) {
      ++held.all;
      if (std::none_of(carries.begin() + static_cast<std::ptrdiff_t>(quadratic ? corners : 0), carries.end(), [](char one) { return one != 0; })) {
        ++held.held;
        held.quadratic |= quadratic;
        for (const LocalOrdinal node : facet)
          for (int i = 0; i < dim; ++i) {
            const double mark = F_view(node, i);
            (mark == follows_another ? held.follow : mark == crosspoint_mark ? held.shared : held.prescribed) |= mark != 0.0;
          }
        if (held.nodes.size() < named_facets) held.nodes.push_back(written<dim>(ids, points));
      }
    }
    if (!sound(points))
      diagnostics.push_back({place, fmt::format("the slave facet between nodes {} has no area, or is not convex", written<dim>(ids, points))});
    const FacetVector weights = facet_weights(points, measure);
    for (std::size_t j = 0; j < facet.size(); ++j) {
      if (static_cast<std::size_t>(facet[j]) >= surface.owned.size()) continue;
      surface.owned[facet[j]].middle = j >= corners;
      surface.owned[facet[j]].weight += weights[static_cast<Eigen::Index>(j)];
      surface.facets_of[facet[j]].push_back(surface.facets.size());
    }
    surface.facets.push_back(facet);
    surface.normals.push_back(facet);
    surface.multipliers.push_back({multiplier_shares(carries, corners), weights});
  }
  if (const auto refusal = refusal_of(held, *owned_nodes->getComm(), place)) diagnostics.push_back(*refusal);
  throw_if_any(*owned_nodes->getComm(), diagnostics);
  return surface;
}

template SlaveSurface make_slave_surface<2>(const RCP<const Map>&, const RCP<const MultiVector>&, const RCP<const MultiVector>&, const SurfaceFacets&,
                                            const InterfaceMeasure&, const Place&);
template SlaveSurface make_slave_surface<3>(const RCP<const Map>&, const RCP<const MultiVector>&, const RCP<const MultiVector>&, const SurfaceFacets&,
                                            const InterfaceMeasure&, const Place&);

}  // namespace mortise
