#include "distribution/facet_distribution.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>

#include "exchange/exchange.hpp"

namespace mortise {
namespace {

SurfaceFacet ids_of(const Facet<LocalOrdinal>& facet, const SlaveSurface& slave) {
  SurfaceFacet ids;
  for (const LocalOrdinal node : facet) ids.push_back(slave.node_ids[node]);
  return ids;
}

// One number for each rank, summed over all ranks.
std::vector<double> summed(const Communicator& comm, const std::vector<double>& mine) {
  std::vector<double> all(mine.size());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

void put(WordWriter& to, const TravellingFacet& facet) {
  to.put_list(facet.nodes);
  to.put_list(facet.receivers);
  for (const auto& stencil : facet.stencils) {
    to.put(stencil.facets.size());
    for (const auto& tangents : stencil.facets) {
      to.put_list(tangents.nodes);
      to.put_matrix(tangents.slope);
    }
    for (const bool projected : stencil.projected) to.put(projected);
    to.put(stencil.of_node);
  }
  to.put_matrix(facet.multipliers.share);
  to.put_matrix(facet.multipliers.weights);
  to.put(facet.candidates.size());
  for (const SurfaceFacet& candidate : facet.candidates) to.put_list(candidate);
}

SurfaceFacet get_facet(WordReader& from) {
  SurfaceFacet ids;
  from.get_list<GlobalOrdinal>([&](GlobalOrdinal id) { ids.push_back(id); });
  return ids;
}

TravellingFacet get(WordReader& from) {
  TravellingFacet facet;
  facet.nodes = get_facet(from);
  from.get_list<int>([&](int rank) { facet.receivers.push_back(rank); });
  facet.stencils.resize(facet.nodes.size());
  for (auto& stencil : facet.stencils) {
    stencil.facets.resize(from.get<std::size_t>());
    for (auto& tangents : stencil.facets) {
      tangents.nodes = get_facet(from);
      from.get_matrix(tangents.slope);
    }
    for (bool& projected : stencil.projected) projected = from.get<bool>();
    stencil.of_node = from.get<bool>();
  }
  from.get_matrix(facet.multipliers.share);
  from.get_matrix(facet.multipliers.weights);
  facet.candidates.resize(from.get<std::size_t>());
  for (SurfaceFacet& candidate : facet.candidates) candidate = get_facet(from);
  return facet;
}

}  // namespace

FacetDistribution::FacetDistribution(const RCP<const Map>& owned_nodes, const SlaveSurface& slave)
    : comm_(owned_nodes->getComm()), rank_(comm_->getRank()) {
  std::vector<int> owner(slave.nodes_with_normal);
  owned_nodes->getRemoteIndexList(Teuchos::arrayView(slave.node_ids.data(), static_cast<Teuchos_Ordinal>(owner.size())),
                                  Teuchos::arrayViewFromVector(owner));
  for (const auto& facet : slave.facets) {
    std::vector<int> ranks;
    for (const LocalOrdinal node : facet) ranks.push_back(owner[node]);
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    ids_.push_back(ids_of(facet, slave));
    home_.push_back(home_of(ids_.back(), ranks));
    number_[ids_.back()] = receivers_.size();
    receivers_.push_back(std::move(ranks));
  }
  integrator_ = home_;
}

double FacetDistribution::imbalance(const std::vector<double>& work, bool as_owned) const {
  std::vector<double> of_rank(static_cast<std::size_t>(comm_->getSize()), 0.0);
  for (std::size_t f = 0; f < home_.size(); ++f)
    if (is_home(f)) of_rank[as_owned ? home_[f] : integrator_[f]] += work[f];
  return largest_over_mean(summed(*comm_, of_rank));
}

bool FacetDistribution::redistribute(const std::vector<PartitionedFacet>& facets, double bound) {
  const auto ranks = static_cast<std::size_t>(comm_->getSize());
  std::vector<std::size_t> homes;
  std::vector<PartitionedFacet> mine;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (!is_home(f)) continue;
    homes.push_back(f);
    mine.push_back(facets[f]);
  }
  const std::vector<int> part = partition_facets(comm_, mine, comm_->getSize());
  std::vector<double> now(ranks, 0.0), then(ranks, 0.0);
  for (std::size_t h = 0; h < homes.size(); ++h) {
    now[integrator_[homes[h]]] += mine[h].work;
    then[part[h]] += mine[h].work;
  }
  if (!worth_moving(largest_over_mean(summed(*comm_, now)), largest_over_mean(summed(*comm_, then)), bound)) return false;

  std::vector<Words> told(ranks);  // homes tell the receivers
  for (std::size_t h = 0; h < homes.size(); ++h)
    for (const int receiver : receivers_[homes[h]]) {
      WordWriter to(told[receiver]);
      to.put_list(ids_[homes[h]]);
      to.put(part[h]);
    }
  for (const Words& words : all_to_all(*comm_, told))
    for (WordReader from(words); !from.at_end();) {
      const std::size_t f = facet_of(get_facet(from));
      integrator_[f] = from.get<int>();
    }
  return true;
}

std::vector<TravellingFacet> FacetDistribution::send_away(const SlaveSurface& slave, const std::vector<SurfaceFacets>& candidates) {
  std::vector<Words> sent(static_cast<std::size_t>(comm_->getSize()));
  for (std::size_t f = 0; f < home_.size(); ++f) {
    if (!is_home(f) || std::binary_search(receivers_[f].begin(), receivers_[f].end(), integrator_[f])) continue;
    TravellingFacet facet{ids_[f], receivers_[f], {}, slave.multipliers[f], candidates[f]};
    for (const LocalOrdinal normal : slave.normals[f]) {
      const NormalStencil& stencil = slave.stencils[normal];
      facet.stencils.push_back({{}, stencil.projected, static_cast<std::size_t>(normal) < slave.nodes_with_normal});
      for (const NodeTangents& tangents : stencil.facets) facet.stencils.back().facets.push_back({ids_of(tangents.nodes, slave), tangents.slope});
    }
    WordWriter to(sent[integrator_[f]]);
    put(to, facet);
  }
  std::vector<TravellingFacet> here;
  for (const Words& words : all_to_all(*comm_, sent))
    for (WordReader from(words); !from.at_end();) here.push_back(get(from));

  outgoing_.clear();
  sources_.clear();
  const auto expect_receivers = [&](const std::vector<int>& receivers) {
    for (const int receiver : receivers)
      if (receiver != rank_) outgoing_[receiver];
  };
  for (const TravellingFacet& facet : here) expect_receivers(facet.receivers);
  for (std::size_t f = 0; f < home_.size(); ++f)
    if (integrated_here(f))
      expect_receivers(receivers_[f]);
    else
      sources_.insert(integrator_[f]);
  return here;
}

std::vector<Words> FacetDistribution::exchange() {
  std::vector<Words> received = exchange_with_neighbours(*comm_, outgoing_, sources_);
  for (auto& [receiver, words] : outgoing_) words.clear();
  return received;
}

}  // namespace mortise
