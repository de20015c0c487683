#include "slave/facet_placement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "exchange/exchange.hpp"

namespace mortise {
namespace {

using Owners = std::map<GlobalOrdinal, int>;

// Collective: of all nodes of this rank's facets; -1 where there is none.
Owners owners_of(const Map& owned_nodes, const SurfaceFacets& facets) {
  std::set<GlobalOrdinal> nodes;
  for (const SurfaceFacet& facet : facets) nodes.insert(facet.begin(), facet.end());
  const std::vector<GlobalOrdinal> ids(nodes.begin(), nodes.end());
  std::vector<int> ranks(ids.size());
  owned_nodes.getRemoteIndexList(Teuchos::arrayViewFromVector(ids), Teuchos::arrayViewFromVector(ranks));
  Owners owners;
  for (std::size_t n = 0; n < ids.size(); ++n) owners[ids[n]] = ranks[n];
  return owners;
}

void find_unknown_node(const Owners& owners, const char* side, const Place& place, std::vector<Diagnostic>& diagnostics) {
  const auto unknown = std::find_if(owners.begin(), owners.end(), [](const auto& node) { return node.second < 0; });
  if (unknown != owners.end())
    diagnostics.push_back({place, fmt::format("the {} surface names node {}, which the model does not have", side, unknown->first)});
}

std::string ids_of(const SurfaceFacet& facet) { return fmt::format("{}", fmt::join(facet, ", ")); }

// Slave facets of this rank of which it owns no node, and those that it gives twice.
void find_needless_slave_facet(int rank, const SurfaceFacets& slave, const Owners& owners, const Place& place, std::vector<Diagnostic>& diagnostics) {
  std::set<SurfaceFacet> seen;
  for (const SurfaceFacet& facet : slave) {
    if (std::none_of(facet.begin(), facet.end(), [&](GlobalOrdinal node) { return owners.at(node) == rank; })) {
      diagnostics.push_back({place, fmt::format("the slave facet of nodes {} is given on rank {}, which owns none of them; give every slave facet on "
                                                "each rank that owns a node of it, and on no other",
                                                ids_of(facet), rank)});
      return;
    }
    SurfaceFacet sorted = facet;
    std::sort(sorted.begin(), sorted.end());
    if (seen.insert(sorted).second) continue;
    diagnostics.push_back({place, fmt::format("the slave facet of nodes {} is given twice on rank {}", ids_of(facet), rank)});
    return;
  }
}

// Every facet goes to the owners of its nodes, which look whether they have it.
void find_missing_slave_facet(const Communicator& comm, const SurfaceFacets& slave, const Owners& owners, const Place& place,
                              std::vector<Diagnostic>& diagnostics) {
  std::vector<std::vector<FacetIds>> send(comm.getSize());
  for (const SurfaceFacet& facet : slave) {
    std::set<int> ranks;
    for (const GlobalOrdinal node : facet) ranks.insert(owners.at(node));
    ranks.erase(comm.getRank());
    for (const int rank : ranks) send[rank].emplace_back(facet);
  }
  const std::set<SurfaceFacet> mine(slave.begin(), slave.end());
  const auto received = all_to_all(comm, send);
  for (std::size_t rank = 0; rank < received.size(); ++rank)
    for (const FacetIds& ids : received[rank])
      if (const SurfaceFacet facet = ids.facet(); mine.count(facet) == 0) {
        diagnostics.push_back(
            {place, fmt::format("the slave facet of nodes {}, as rank {} gives it, is not given on rank {}, which owns a node of it; "
                                "give every slave facet, its nodes in one order, on each rank that owns a node of it",
                                ids_of(facet), rank, comm.getRank())});
        return;
      }
}

// Every facet goes to the owner of its lowest node, which counts.
void find_repeated_master_facet(const Communicator& comm, const SurfaceFacets& master, const Owners& owners, const Place& place,
                                std::vector<Diagnostic>& diagnostics) {
  std::vector<std::vector<FacetIds>> send(comm.getSize());
  for (SurfaceFacet facet : master) {
    std::sort(facet.begin(), facet.end());
    send[owners.at(facet.front())].emplace_back(facet);
  }
  std::map<SurfaceFacet, std::size_t> given_by;
  const auto received = all_to_all(comm, send);
  for (std::size_t rank = 0; rank < received.size(); ++rank)
    for (const FacetIds& ids : received[rank]) {
      const auto [first, inserted] = given_by.insert({ids.facet(), rank});
      if (inserted) continue;
      diagnostics.push_back(
          {place, fmt::format("the master facet of nodes {} is given on rank {} and again on rank {}; give every master facet once, on one "
                              "rank",
                              ids_of(first->first), first->second, rank)});
      return;
    }
}

}  // namespace

void refuse_misplaced_facets(const Map& owned_nodes, const SurfaceFacets& slave, const SurfaceFacets& master, const Place& place) {
  const Communicator& comm = *owned_nodes.getComm();
  std::vector<Diagnostic> diagnostics;
  const Owners slave_owners = owners_of(owned_nodes, slave), master_owners = owners_of(owned_nodes, master);
  find_unknown_node(slave_owners, "slave", place, diagnostics);
  find_unknown_node(master_owners, "master", place, diagnostics);
  throw_if_any(comm, diagnostics);
  find_needless_slave_facet(comm.getRank(), slave, slave_owners, place, diagnostics);
  find_missing_slave_facet(comm, slave, slave_owners, place, diagnostics);
  find_repeated_master_facet(comm, master, master_owners, place, diagnostics);
  throw_if_any(comm, diagnostics);
}

}  // namespace mortise
