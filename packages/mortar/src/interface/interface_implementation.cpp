#include "interface/interface_implementation.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "interface/interface.hpp"
#include "search/yielding_sides.hpp"

namespace mortise {
namespace {

RCP<const Map> map_of(const std::vector<GlobalOrdinal>& ids, const RCP<const Communicator>& comm) {
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
}

std::vector<GlobalOrdinal> nodes_of(const SurfaceFacets& facets) {
  std::set<GlobalOrdinal> nodes;
  for (const SurfaceFacet& facet : facets) nodes.insert(facet.begin(), facet.end());
  return {nodes.begin(), nodes.end()};
}

/// Between two real searches no node moves further than this share of the least facet height.
constexpr double free_motion = 0.1;
/// The most that a facet turns until the next search.
const double turn_until_next = std::asin(2.0 * free_motion);

}  // namespace

template <int dim>
Interface<dim>::Interface(const InterfaceInput& input)
    : owned_nodes_(input.owned_nodes),
      measure_(input.measure),
      options_(input.options),
      master_(input.master),
      integrator_(input.measure, input.options) {
  slave = make_slave_surface<dim>(owned_nodes_, input.reference, input.fixed, input.slave, measure_, input.place);
  for (SlaveNode& node : slave.owned) node.weight *= options_.share;
  kinks_.is_kink.assign(slave.nodes_with_normal, 0);
  kinks_.takes_normal_of.resize(slave.nodes_with_normal);
  slave_positions_ = std::make_unique<Gathered<dim>>(owned_nodes_, slave.node_ids);
  master_positions_ = std::make_unique<Gathered<dim>>(owned_nodes_, nodes_of(master_));
  measure_facets(*input.reference, input.place);
  release_leaning_nodes(*input.reference);
  candidate_ids_.resize(slave.facets.size());
  segments_of_facet_.assign(slave.facets.size(), 0);
  if (owned_nodes_->getComm()->getSize() > 1 && options_.coupling->integrates_facets())
    distribution_ = std::make_unique<FacetDistribution>(owned_nodes_, slave);
  number_nodes();
}

template <int dim>
void Interface<dim>::measure_facets(const MultiVector& reference, const Place& place) {
  const Communicator& comm = *owned_nodes_->getComm();
  const Positions<dim> slave_x = (*slave_positions_)(reference);
  const std::vector<PlacedFacet<dim>> placed = place_master(reference);
  std::vector<Diagnostic> diagnostics;
  const double counts[2] = {static_cast<double>(slave.facets.size()), static_cast<double>(master_.size())};
  double totals[2];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, counts, totals);
  if (totals[0] == 0.0) diagnostics.push_back({place, "the slave surface is empty"});
  if (totals[1] == 0.0) diagnostics.push_back({place, "the master surface is empty"});
  double extent[2] = {-std::numeric_limits<double>::max(), 0.0}, all[2];  // -shortest, longest
  for (const auto& facet : slave.facets) {
    const FacetPoints<dim> points = points_of<dim>(facet, slave_x);
    extent[0] = std::max(extent[0], -shortest_edge<dim>(points));
    extent[1] = std::max(extent[1], longest_edge<dim>(points));
  }
  for (std::size_t f = 0; f < placed.size(); ++f) {
    const FacetPoints<dim> points = placed[f].points();
    extent[1] = std::max(extent[1], longest_edge<dim>(points));
    if (facet_height(points) > 0.0) continue;
    std::string nodes;
    for (std::size_t a = 0; a < master_[f].size(); ++a)
      nodes += fmt::format("{}{}", a == 0 ? "" : (a + 1 == master_[f].size() ? " and " : ", "), master_[f][a]);
    diagnostics.push_back({place, fmt::format("the master facet between nodes {} has no {}", nodes, dim == 2 ? "length" : "area")});
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, extent, all);
  shortest = -all[0];
  longest = all[1];
  throw_if_any(comm, diagnostics);
  reach = options_.search_reach.value_or(longest);
}

template <int dim>
bool Interface<dim>::moved(const MultiVector& x) const {
  if (searched_at_.is_null()) return true;
  MultiVector difference(x, Teuchos::Copy);
  difference.update(-1.0, *searched_at_, 1.0);
  Teuchos::Array<double> largest(dim);
  difference.normInf(largest());
  return Eigen::Map<const Eigen::Matrix<double, dim, 1>>(largest.getRawPtr()).norm() > free_distance_;
}

// The master facets of this rank. Collective.
template <int dim>
std::vector<PlacedFacet<dim>> Interface<dim>::place_master(const MultiVector& x) {
  const Positions<dim> master_x = (*master_positions_)(x);
  std::vector<PlacedFacet<dim>> placed;
  for (const SurfaceFacet& facet : master_) {
    FacetPoints<dim> points;
    for (const GlobalOrdinal node : facet) points.push_back(master_x[master_positions_->local(node)]);
    placed.push_back({facet, points});
  }
  return placed;
}

// Over all ranks, in the given positions. Collective.
template <int dim>
double Interface<dim>::least_height(const Positions<dim>& slave_x, const std::vector<PlacedFacet<dim>>& placed_master) const {
  double mine = std::numeric_limits<double>::max(), all = 0.0;
  for (const auto& facet : slave.facets) mine = std::min(mine, facet_height(points_of<dim>(facet, slave_x)));
  for (const PlacedFacet<dim>& facet : placed_master) mine = std::min(mine, facet_height(facet.points()));
  Teuchos::reduceAll(*owned_nodes_->getComm(), Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all;
}

// The master facets that each slave facet may overlap within reach + its longest edge after a motion. Beside a corner of the master these are all
// that are as near, since which of them take part depends on the others. Collective.
template <int dim>
typename Interface<dim>::Candidates Interface<dim>::find(const Positions<dim>& x, const std::vector<PlacedFacet<dim>>& placed_master,
                                                         const Motion& motion) const {
  std::vector<PlacedFacet<dim>> placed;
  std::vector<double> radius;
  for (const auto& facet : slave.facets) {
    SurfaceFacet ids;
    for (const LocalOrdinal node : facet) ids.push_back(slave.node_ids[node]);
    const FacetPoints<dim> points = points_of<dim>(facet, x);
    placed.push_back({ids, points});
    radius.push_back(reach + longest_edge<dim>(points) + 2.0 * motion.approach);  // the distance shrinks, the facet grows
  }
  const auto near = facets_within<dim>(*owned_nodes_->getComm(), placed, radius, placed_master);
  Candidates result(near.size());
  std::vector<NodalNormal> normals;
  for (std::size_t f = 0; f < near.size(); ++f) {
    const auto& facet = slave.facets[f];
    normals.resize(facet.size());
    bool sound = true;
    for (std::size_t j = 0; j < facet.size(); ++j) sound = average_normal(slave.stencils[slave.normals[f][j]], x, false, normals[j]) && sound;
    if (!sound) continue;  // evaluate() says what is wrong
    const OverlapTest<dim> may_overlap(points_of<dim>(facet, x), normals, motion);
    bool beside_corner = !options_.coupling->integrates_facets() && slave.normals[f] != facet;  // a corner's line may run between those of its facets
    if constexpr (dim == 2) beside_corner = beside_corner || any_may_yield(near[f], 2.0 * turn_until_next);
    for (const PlacedFacet<dim>& one : near[f])
      if (beside_corner || may_overlap(one.points())) result[f].push_back(one.ids());
  }
  return result;
}

template <int dim>
bool Interface<dim>::retain(const std::shared_ptr<const RetainedNodes>& nodes) {
  if (nodes == retained_) return retained_is_new_;
  retained_ = nodes;
  double missing = 0.0, any = 0.0;
  for (std::size_t s = 0; nodes != nullptr && s < nodes->size() && missing == 0.0; ++s)
    for (const GlobalOrdinal id : (*nodes)[s]) {
      const LocalOrdinal node = local_nodes->getLocalElement(id);
      if (node < 0 || !std::binary_search(pattern->coupled[s].begin(), pattern->coupled[s].end(), node)) missing = 1.0;
    }
  Teuchos::reduceAll(*owned_nodes_->getComm(), Teuchos::REDUCE_MAX, missing, Teuchos::outArg(any));
  retained_is_new_ = any > 0.0;
  return retained_is_new_;
}

// Sums over nodes go by their numbers: these must not depend on which candidates earlier searches found.
template <int dim>
void Interface<dim>::number_nodes() {
  std::vector<GlobalOrdinal> ids = slave.node_ids;
  std::map<GlobalOrdinal, LocalOrdinal> local_of;
  for (std::size_t n = 0; n < ids.size(); ++n) local_of.insert({ids[n], static_cast<LocalOrdinal>(n)});
  const auto local = [&](GlobalOrdinal id) {
    const auto [found, is_new] = local_of.insert({id, static_cast<LocalOrdinal>(ids.size())});
    if (is_new) ids.push_back(id);
    return found->second;
  };
  std::set<GlobalOrdinal> others;
  for (const SurfaceFacets& facets : candidate_ids_)
    for (const SurfaceFacet& facet : facets) others.insert(facet.begin(), facet.end());
  std::vector<std::vector<LocalOrdinal>> kept(slave.owned.size());
  if (retained_ != nullptr)
    for (const auto& nodes : *retained_) others.insert(nodes.begin(), nodes.end());
  for (const GlobalOrdinal id : others) local(id);

  candidates_.assign(slave.facets.size(), {});
  for (std::size_t f = 0; f < slave.facets.size(); ++f)
    for (const SurfaceFacet& facet : candidate_ids_[f]) {
      candidates_[f].emplace_back();
      for (const GlobalOrdinal id : facet) candidates_[f].back().push_back(local(id));
    }
  if (!options_.coupling->integrates_facets()) collect_met();
  for (std::size_t s = 0; retained_ != nullptr && s < retained_->size(); ++s)
    for (const GlobalOrdinal id : (*retained_)[s]) kept[s].push_back(local(id));
  if (distribution_) guests_ = GuestFacets(distribution_->send_away(slave, candidate_ids_), slave, local);
  const auto next = std::make_shared<InterfacePattern>();
  next->local_nodes = local_nodes = map_of(ids, owned_nodes_->getComm());
  next->import = rcp(new Import(owned_nodes_, local_nodes));
  auto &coupled = next->coupled, &loaded = next->loaded;
  coupled.assign(slave.owned.size(), {});
  loaded.assign(slave.owned.size(), {});
  const bool on_whole_facets = options_.coupling->integrates_facets() && !options_.coupling->has_dual_multipliers();
  const bool turn_with_both_sides = options_.corner_rule(dim) == CornerRule::master_normal;
  for (std::size_t s = 0; s < slave.owned.size(); ++s) {
    loaded[s].push_back(slave.owned[s].local_node);
    for (const std::size_t f : slave.facets_of[s]) {
      coupled[s].insert(coupled[s].end(), slave.facets[f].begin(), slave.facets[f].end());
      if (turn_with_both_sides) couple_beyond_corners(f, coupled[s]);
      for (const LocalOrdinal node : slave.facets[f]) {
        const auto& columns = slave.stencils[node].columns;
        coupled[s].insert(coupled[s].end(), columns.begin(), columns.end());
        if (on_whole_facets || slave.may_load(dim, f, slave.owned[s].local_node, node)) loaded[s].push_back(node);
      }
      for (const auto& facet : candidates_[f]) loaded[s].insert(loaded[s].end(), facet.begin(), facet.end());
    }
    coupled[s].insert(coupled[s].end(), loaded[s].begin(), loaded[s].end());
    if (options_.coupling->has_forces_of_gaps()) loaded[s] = coupled[s];
    coupled[s].insert(coupled[s].end(), kept[s].begin(), kept[s].end());
    for (std::vector<LocalOrdinal>* nodes : {&coupled[s], &loaded[s]}) {
      std::sort(nodes->begin(), nodes->end());
      nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
    }
  }
  pattern = next;
  retained_is_new_ = false;
}

// A corner's normal depends on both of its facets, and so do the couplings of either.
template <int dim>
void Interface<dim>::couple_beyond_corners(std::size_t facet, std::vector<LocalOrdinal>& nodes) const {
  for (const LocalOrdinal corner : slave.facets[facet]) {
    if (static_cast<std::size_t>(corner) >= slave.owned.size() || kinks_.is_kink[corner] == 0) continue;
    for (const std::size_t f : slave.facets_of[corner]) {
      for (const LocalOrdinal node : slave.facets[f]) {
        const auto& columns = slave.stencils[node].columns;
        nodes.insert(nodes.end(), columns.begin(), columns.end());
      }
      for (const auto& candidate : candidates_[f]) nodes.insert(nodes.end(), candidate.begin(), candidate.end());
    }
  }
}

// The candidates of the facets of each node, by ids: in an order that is the same on every rank.
template <int dim>
void Interface<dim>::collect_met() {
  met_.assign(slave.owned.size(), {});
  for (std::size_t s = 0; s < met_.size(); ++s) {
    std::map<SurfaceFacet, Facet<LocalOrdinal>> facets;
    for (const std::size_t f : slave.facets_of[s])
      for (std::size_t c = 0; c < candidates_[f].size(); ++c) facets.insert({candidate_ids_[f][c], candidates_[f][c]});
    for (const auto& [ids, facet] : facets) met_[s].push_back(facet);
  }
}

template <int dim>
bool Interface<dim>::search(const MultiVector& x) {
  if (!moved(x)) {
    if (!retained_is_new_) return false;
    number_nodes();
    return true;
  }
  Teuchos::Array<double> sizes(dim);
  x.norm1(sizes());
  for (const double size : sizes)
    if (!std::isfinite(size)) {  // evaluate() says what is wrong, with the kinks and retained nodes that are set
      number_nodes();
      return true;
    }
  const bool first = searched_at_.is_null();
  const Positions<dim> slave_x = (*slave_positions_)(x);
  const std::vector<PlacedFacet<dim>> placed = place_master(x);
  searched_at_ = rcp(new MultiVector(x, Teuchos::Copy));
  free_distance_ = free_motion * least_height(slave_x, placed);
  const Motion until_next = {2.0 * free_distance_, turn_until_next};
  const Motion longer = {4.0 * free_distance_, std::asin(4.0 * free_motion)};
  // All facets needed until the next search have to be among the candidates; only then they, and the pattern, may stay as they are.
  const Candidates needed = first ? Candidates() : find(slave_x, placed, until_next);
  double missing = first, any = 0.0;
  for (std::size_t f = 0; f < needed.size(); ++f)
    if (!std::includes(candidate_ids_[f].begin(), candidate_ids_[f].end(), needed[f].begin(), needed[f].end())) missing = 1.0;
  Teuchos::reduceAll(*owned_nodes_->getComm(), Teuchos::REDUCE_MAX, missing, Teuchos::outArg(any));
  if (any > 0.0) candidate_ids_ = find(slave_x, placed, longer);
  if (!balance(slave_x) && any == 0.0 && !retained_is_new_) return false;
  number_nodes();
  return true;
}

// Gives slave facets to other ranks where the work of ranks differs too much; whether it did. Before anything is integrated the candidates stand for
// the segments; a facet that has candidates only costs as much as one segment. Collective.
template <int dim>
bool Interface<dim>::balance(const Positions<dim>& slave_x) {
  if (!distribution_) return false;
  std::vector<double> work;
  for (std::size_t f = 0; f < slave.facets.size(); ++f)
    work.push_back(
        static_cast<double>(counted_ && !candidate_ids_[f].empty() ? std::max<std::size_t>(1, segments_of_facet_[f]) : candidate_ids_[f].size()));
  load.imbalance_as_owned = distribution_->imbalance(work, true);
  if (distribution_->imbalance(work, false) <= options_.balance) return false;
  std::vector<PartitionedFacet> facets;
  for (std::size_t f = 0; f < slave.facets.size(); ++f) {
    PartitionedFacet& facet = facets.emplace_back();
    facet.work = work[f];
    for (const LocalOrdinal node : slave.facets[f])
      for (int i = 0; i < dim; ++i) facet.centre[i] += slave_x[node][i] / static_cast<double>(slave.facets[f].size());
  }
  const bool moved = distribution_->redistribute(facets, options_.balance);
  load.redistributions += moved;
  return moved;
}

template <int dim>
std::vector<std::optional<double>> Interface<dim>::distances_to_master(const MultiVector& x, const std::vector<std::size_t>& nodes,
                                                                       const std::vector<SpatialVector>& normals) {
  const std::vector<PlacedFacet<dim>> placed = place_master(x);
  const Positions<dim> positions = positions_of<dim>(x.getLocalViewHost(Tpetra::Access::ReadOnly));
  std::vector<NormalLine<dim>> lines;
  for (std::size_t n = 0; n < nodes.size(); ++n) lines.push_back({positions[slave.owned[nodes[n]].owned_node], normals[n]});
  return distances_along_normals<dim>(*owned_nodes_->getComm(), lines, placed);
}

template <int dim>
Gathered<dim>::Gathered(const RCP<const Map>& owned_nodes, const std::vector<GlobalOrdinal>& ids)
    : map_(map_of(ids, owned_nodes->getComm())), import_(owned_nodes, map_), positions_(map_, dim) {}

template <int dim>
Positions<dim> Gathered<dim>::operator()(const MultiVector& x) {
  positions_.doImport(x, import_, Tpetra::REPLACE);
  return positions_of<dim>(positions_.getLocalViewHost(Tpetra::Access::ReadOnly));
}

template <int dim>
std::unique_ptr<InterfaceImplementation> make_interface(const InterfaceInput& input) {
  return std::make_unique<Interface<dim>>(input);
}

template std::unique_ptr<InterfaceImplementation> make_interface<2>(const InterfaceInput&);
template std::unique_ptr<InterfaceImplementation> make_interface<3>(const InterfaceInput&);

}  // namespace mortise
