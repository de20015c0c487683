#include "mortise/mortar/mortar_interface.hpp"

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

#include "facet_coupling_2d.hpp"
#include "mortise/mortar/surface_nodes.hpp"
#include "node_coupling_2d.hpp"
#include "slave_surface_2d.hpp"
#include "surface_search.hpp"

namespace mortise {
namespace {

using FacetIds = std::array<GlobalOrdinal, 2>;

RCP<const Map> map_of(const std::vector<GlobalOrdinal>& ids, const RCP<const Communicator>& comm) {
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
}

// Positions of some nodes of all ranks.
class Gathered {
 public:
  Gathered(const RCP<const Map>& owned_nodes, std::vector<GlobalOrdinal> ids)
      : map_(map_of(ids, owned_nodes->getComm())), import_(owned_nodes, map_), positions_(map_, 2) {}

  Positions operator()(const MultiVector& x) {
    positions_.doImport(x, import_, Tpetra::REPLACE);
    const auto view = positions_.getLocalViewHost(Tpetra::Access::ReadOnly);
    Positions result(view.extent(0));
    for (std::size_t n = 0; n < result.size(); ++n) result[n] = {view(n, 0), view(n, 1)};
    return result;
  }
  LocalOrdinal local(GlobalOrdinal node) const { return map_->getLocalElement(node); }

 private:
  RCP<const Map> map_;
  Import import_;
  MultiVector positions_;
};

std::vector<GlobalOrdinal> nodes_of(const SurfaceFacets& facets) {
  std::set<GlobalOrdinal> nodes;
  for (const SurfaceFacet& facet : facets) nodes.insert(facet.begin(), facet.end());
  return {nodes.begin(), nodes.end()};
}

/// Between two real searches no node moves further than this share of the shortest facet.
constexpr double free_motion = 0.1;

// What such motions can do to a pair of facets: ends come nearer by `approach`, facets and so nodal normals turn by `turn`.
struct Motion {
  double approach, turn;
};

// Whether the master facet b may lie under the slave facet a, seen along its nodal normals, after a motion.
bool may_overlap(const std::array<Eigen::Vector2d, 2>& a, const std::array<Eigen::Vector2d, 2>& b, const std::array<Eigen::Vector2d, 2>& normals,
                 const Motion& motion) {
  const double length = (a[1] - a[0]).norm();
  const Eigen::Vector2d n = facet_normal(a[0], a[1]), t(-n.y(), n.x());
  double lean = 0.0;  // of the nodal normals to the sides, as an angle
  for (const Eigen::Vector2d& normal : normals) lean = std::max(lean, std::atan2(std::abs(normal.dot(t)), normal.dot(n)));
  lean += 2.0 * motion.turn;  // the normal's own turn and that of the facet
  if (lean > 1.5) return true;
  const Eigen::Vector2d start = b[0] - a[0], end = b[1] - a[0];
  const double height = std::max(std::abs(start.dot(n)), std::abs(end.dot(n)));
  const double slack = 2.0 * motion.approach + std::tan(lean) * (height + 2.0 * motion.approach);
  return std::max(start.dot(t), end.dot(t)) >= -slack && std::min(start.dot(t), end.dot(t)) <= length + slack;
}

}  // namespace

// Candidates of a slave facet, kept from search to search: a superset of the master facets it can overlap now. Which of them take part is
// decided in evaluate() from positions alone, so no result depends on when the last search was:
//   the facet takes part if a master facet that it overlaps lies within the reach; then all within reach + its length do.
struct MortarInterface::Implementation {
  RCP<const Map> owned_nodes;
  InterfaceMeasure measure;
  MortarOptions options;
  SlaveSurface2d slave;
  SurfaceFacets master;
  double shortest = 0.0, longest = 0.0, reach = 0.0;

  std::unique_ptr<Gathered> slave_positions, master_positions;
  std::vector<std::vector<FacetIds>> candidate_ids;                  ///< [facets] ascending
  std::vector<std::vector<std::array<LocalOrdinal, 2>>> candidates;  ///< [facets] as local nodes
  std::vector<std::vector<std::array<LocalOrdinal, 2>>> met;         ///< [owned slave nodes] candidates of their facets; node to segment only
  std::vector<std::vector<LocalOrdinal>> coupled, loaded;            ///< [owned slave nodes]
  RCP<const Map> local_nodes;
  RCP<MultiVector> searched_at;                      ///< owned positions of the last real search
  double free_distance = 0.0;                        ///< that every node may move from there without another one
  std::vector<std::vector<GlobalOrdinal>> retained;  ///< [owned slave nodes]; empty: none
  mutable FacetIntegrator2d integrator;

  Implementation(const InterfaceMeasure& m, const MortarOptions& o) : measure(m), options(o), integrator(m, o) {}

  double generous(double length) const { return reach + length; }
  void measure_facets(const MultiVector& reference, const Place& place);
  bool moved(const MultiVector& x) const;
  std::vector<PlacedFacet> place_master(const MultiVector& x) const;
  double shortest_now(const Positions& slave_x, const std::vector<PlacedFacet>& placed_master) const;
  std::vector<std::vector<FacetIds>> find(const Positions& x, const std::vector<PlacedFacet>& placed_master, const Motion& motion) const;
  void number_nodes();
  void collect_met();
  std::size_t couple_facets(const Positions& x, bool derivatives, const std::vector<NodalNormal>& normals,
                            std::vector<FacetCoupling>& couplings) const;
  std::size_t couple_nodes(const Positions& x, bool derivatives, const std::vector<NodalNormal>& normals,
                           std::vector<FacetCoupling>& couplings) const;
};

void MortarInterface::Implementation::measure_facets(const MultiVector& reference, const Place& place) {
  const Positions slave_x = (*slave_positions)(reference), master_x = (*master_positions)(reference);
  double extent[2] = {-std::numeric_limits<double>::max(), 0.0}, all[2];  // -shortest, longest
  std::vector<Diagnostic> diagnostics;
  const auto take = [&](double length) {
    extent[0] = std::max(extent[0], -length);
    extent[1] = std::max(extent[1], length);
  };
  std::array<double, 2> own{};
  for (const auto& facet : slave.facets) {
    const double length = (slave_x[facet[1]] - slave_x[facet[0]]).norm();
    take(length);
  }
  const double counts[2] = {static_cast<double>(slave.facets.size()), static_cast<double>(master.size())};
  Teuchos::reduceAll(*owned_nodes->getComm(), Teuchos::REDUCE_SUM, 2, counts, own.data());
  if (own[0] == 0.0) diagnostics.push_back({place, "the slave surface is empty"});
  if (own[1] == 0.0) diagnostics.push_back({place, "the master surface is empty"});
  Teuchos::reduceAll(*owned_nodes->getComm(), Teuchos::REDUCE_MAX, 2, extent, all);
  shortest = -all[0];
  for (const SurfaceFacet& facet : master) {
    const double length = (master_x[master_positions->local(facet[1])] - master_x[master_positions->local(facet[0])]).norm();
    if (!(length > 0.0)) diagnostics.push_back({place, fmt::format("the master facet between nodes {} and {} has no length", facet[0], facet[1])});
    extent[1] = std::max(extent[1], length);
  }
  Teuchos::reduceAll(*owned_nodes->getComm(), Teuchos::REDUCE_MAX, 1, &extent[1], &longest);
  throw_if_any(*owned_nodes->getComm(), diagnostics);
  reach = options.search_reach.value_or(longest);
}

MortarInterface::MortarInterface(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                                 const SurfaceFacets& slave, const SurfaceFacets& master, const InterfaceMeasure& measure,
                                 const MortarOptions& options, const Place& place)
    : implementation_(std::make_unique<Implementation>(measure, options)) {
  Implementation& self = *implementation_;
  self.owned_nodes = owned_nodes;
  self.master = master;
  std::vector<Diagnostic> diagnostics;
  const std::vector<char> on_slave = nodes_on_surface(owned_nodes, slave), on_master = nodes_on_surface(owned_nodes, master);
  for (std::size_t node = 0; node < on_slave.size() && diagnostics.empty(); ++node)
    if (on_slave[node] && on_master[node])
      diagnostics.push_back({place, fmt::format("node {} lies on the slave and on the master surface; the two have to be disjoint",
                                                owned_nodes->getGlobalElement(static_cast<LocalOrdinal>(node)))});
  throw_if_any(*owned_nodes->getComm(), diagnostics);

  self.slave = make_slave_surface_2d(owned_nodes, reference, fixed, slave, measure, place);
  for (SlaveNode& node : self.slave.owned) node.weight *= options.share;
  self.slave_positions = std::make_unique<Gathered>(owned_nodes, self.slave.node_ids);
  self.master_positions = std::make_unique<Gathered>(owned_nodes, nodes_of(master));
  self.measure_facets(*reference, place);
  self.candidate_ids.resize(self.slave.facets.size());
  self.number_nodes();
}

MortarInterface::~MortarInterface() = default;

bool MortarInterface::Implementation::moved(const MultiVector& x) const {
  if (searched_at.is_null()) return true;
  MultiVector difference(x, Teuchos::Copy);
  difference.update(-1.0, *searched_at, 1.0);
  Teuchos::Array<double> largest(2);
  difference.normInf(largest());
  return std::hypot(largest[0], largest[1]) > free_distance;
}

// The master facets of this rank. Collective.
std::vector<PlacedFacet> MortarInterface::Implementation::place_master(const MultiVector& x) const {
  const Positions master_x = (*master_positions)(x);
  std::vector<PlacedFacet> placed;
  for (const SurfaceFacet& facet : master) {
    const Eigen::Vector2d &a = master_x[master_positions->local(facet[0])], &b = master_x[master_positions->local(facet[1])];
    placed.push_back({{facet[0], facet[1]}, {{{a.x(), a.y()}, {b.x(), b.y()}}}});
  }
  return placed;
}

// Over all ranks, in the given positions; 0 if a facet has no length. Collective.
double MortarInterface::Implementation::shortest_now(const Positions& slave_x, const std::vector<PlacedFacet>& placed_master) const {
  double mine = std::numeric_limits<double>::max(), all = 0.0;
  for (const auto& facet : slave.facets) mine = std::min(mine, (slave_x[facet[1]] - slave_x[facet[0]]).norm());
  for (const PlacedFacet& facet : placed_master) mine = std::min(mine, std::hypot(facet.x[1][0] - facet.x[0][0], facet.x[1][1] - facet.x[0][1]));
  Teuchos::reduceAll(*owned_nodes->getComm(), Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all;
}

// The master facets that each slave facet may overlap within reach + its length after a motion. Collective.
std::vector<std::vector<FacetIds>> MortarInterface::Implementation::find(const Positions& x, const std::vector<PlacedFacet>& placed_master,
                                                                         const Motion& motion) const {
  std::vector<PlacedFacet> placed;
  std::vector<double> radius;
  for (const auto& facet : slave.facets) {
    const Eigen::Vector2d &a = x[facet[0]], &b = x[facet[1]];
    placed.push_back({{slave.node_ids[facet[0]], slave.node_ids[facet[1]]}, {{{a.x(), a.y()}, {b.x(), b.y()}}}});
    radius.push_back(generous((b - a).norm()) + 2.0 * motion.approach);  // the distance shrinks, the facet grows
  }
  std::vector<std::vector<PlacedFacet>> near = facets_within(*owned_nodes->getComm(), placed, radius, placed_master);
  std::vector<std::vector<FacetIds>> result(near.size());
  for (std::size_t f = 0; f < near.size(); ++f) {
    const std::array<Eigen::Vector2d, 2> a = {x[slave.facets[f][0]], x[slave.facets[f][1]]};
    std::array<Eigen::Vector2d, 2> normals;
    bool sound = true;
    for (int j = 0; j < 2; ++j) {
      NodalNormal normal;
      sound = average_normal(slave.stencils[slave.facets[f][j]], x, false, normal) && sound;
      normals[j] = normal.normal;
    }
    if (!sound) continue;  // evaluate() says what is wrong
    for (const PlacedFacet& one : near[f]) {
      const std::array<Eigen::Vector2d, 2> b = {Eigen::Vector2d(one.x[0][0], one.x[0][1]), Eigen::Vector2d(one.x[1][0], one.x[1][1])};
      if (may_overlap(a, b, normals, motion)) result[f].push_back(one.nodes);
    }
  }
  return result;
}

void MortarInterface::Implementation::number_nodes() {
  std::vector<GlobalOrdinal> ids = slave.node_ids;
  std::map<GlobalOrdinal, LocalOrdinal> local_of;
  for (std::size_t n = 0; n < ids.size(); ++n) local_of.insert({ids[n], static_cast<LocalOrdinal>(n)});
  const auto local = [&](GlobalOrdinal id) {
    const auto [found, is_new] = local_of.insert({id, static_cast<LocalOrdinal>(ids.size())});
    if (is_new) ids.push_back(id);
    return found->second;
  };
  candidates.assign(slave.facets.size(), {});
  for (std::size_t f = 0; f < slave.facets.size(); ++f)
    for (const FacetIds& facet : candidate_ids[f]) candidates[f].push_back({local(facet[0]), local(facet[1])});
  if (options.coupling == Coupling::node_to_segment) collect_met();
  std::vector<std::vector<LocalOrdinal>> kept(slave.owned.size());
  for (std::size_t s = 0; s < retained.size(); ++s)
    for (const GlobalOrdinal id : retained[s]) kept[s].push_back(local(id));
  local_nodes = map_of(ids, owned_nodes->getComm());
  coupled.assign(slave.owned.size(), {});
  loaded.assign(slave.owned.size(), {});
  for (std::size_t s = 0; s < slave.owned.size(); ++s) {
    loaded[s].push_back(slave.owned[s].local_node);
    for (const std::size_t f : slave.facets_of[s]) {
      for (const LocalOrdinal node : slave.facets[f]) {
        const auto& columns = slave.stencils[node].columns;
        coupled[s].insert(coupled[s].end(), columns.begin(), columns.end());
        if (!slave.carries[node] || options.coupling == Coupling::standard_mortar) loaded[s].push_back(node);
      }
      for (const auto& facet : candidates[f]) loaded[s].insert(loaded[s].end(), facet.begin(), facet.end());
    }
    coupled[s].insert(coupled[s].end(), loaded[s].begin(), loaded[s].end());
    coupled[s].insert(coupled[s].end(), kept[s].begin(), kept[s].end());
    for (std::vector<LocalOrdinal>* nodes : {&coupled[s], &loaded[s]}) {
      std::sort(nodes->begin(), nodes->end());
      nodes->erase(std::unique(nodes->begin(), nodes->end()), nodes->end());
    }
  }
}

// The candidates of the facets of each node, by ids: in an order that is the same on every rank.
void MortarInterface::Implementation::collect_met() {
  met.assign(slave.owned.size(), {});
  for (std::size_t s = 0; s < met.size(); ++s) {
    std::map<FacetIds, std::array<LocalOrdinal, 2>> facets;
    for (const std::size_t f : slave.facets_of[s])
      for (std::size_t c = 0; c < candidates[f].size(); ++c) facets.insert({candidate_ids[f][c], candidates[f][c]});
    for (const auto& [ids, facet] : facets) met[s].push_back(facet);
  }
}

bool MortarInterface::search(const MultiVector& x) {
  Implementation& self = *implementation_;
  if (!self.moved(x)) return false;
  Teuchos::Array<double> sizes(2);
  x.norm1(sizes());
  if (!std::isfinite(sizes[0] + sizes[1])) return false;  // evaluate() says what is wrong
  const bool first = self.searched_at.is_null();
  const Positions slave_x = (*self.slave_positions)(x);
  const std::vector<PlacedFacet> placed = self.place_master(x);
  const double shortest = self.shortest_now(slave_x, placed);
  self.searched_at = rcp(new MultiVector(x, Teuchos::Copy));
  self.free_distance = free_motion * shortest;
  const Motion until_next = {2.0 * self.free_distance, std::asin(2.0 * free_motion)};
  const Motion longer = {4.0 * self.free_distance, std::asin(4.0 * free_motion)};
  // What is needed until the next search has to stand among the candidates; only then they, and the pattern, may stay as they are.
  const auto needed = self.find(slave_x, placed, until_next);
  double missing = first, any = 0.0;
  for (std::size_t f = 0; f < needed.size(); ++f)
    if (!std::includes(self.candidate_ids[f].begin(), self.candidate_ids[f].end(), needed[f].begin(), needed[f].end())) missing = 1.0;
  Teuchos::reduceAll(*self.owned_nodes->getComm(), Teuchos::REDUCE_MAX, missing, Teuchos::outArg(any));
  if (any == 0.0) return false;
  self.candidate_ids = self.find(slave_x, placed, longer);
  self.number_nodes();
  return true;
}

std::vector<std::optional<double>> MortarInterface::distances_to_master(const MultiVector& x, const std::vector<std::size_t>& nodes,
                                                                        const std::vector<SpatialVector>& normals) const {
  const Implementation& self = *implementation_;
  const std::vector<PlacedFacet> placed = self.place_master(x);
  const auto positions = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<NormalLine> lines;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const LocalOrdinal node = slave_nodes()[nodes[n]].owned_node;
    lines.push_back({{positions(node, 0), positions(node, 1)}, normals[n]});
  }
  return distances_along_normals(*self.owned_nodes->getComm(), lines, placed);
}

void MortarInterface::retain(std::vector<std::vector<GlobalOrdinal>> nodes) { implementation_->retained = std::move(nodes); }
const RCP<const Map>& MortarInterface::local_nodes() const { return implementation_->local_nodes; }
const std::vector<SlaveNode>& MortarInterface::slave_nodes() const { return implementation_->slave.owned; }
const std::vector<LocalOrdinal>& MortarInterface::coupled_nodes(std::size_t s) const { return implementation_->coupled[s]; }
const std::vector<LocalOrdinal>& MortarInterface::loaded_nodes(std::size_t s) const { return implementation_->loaded[s]; }
double MortarInterface::reach() const { return implementation_->reach; }
double MortarInterface::shortest_facet() const { return implementation_->shortest; }
double MortarInterface::longest_facet() const { return implementation_->longest; }

std::size_t MortarInterface::Implementation::couple_facets(const Positions& x, bool derivatives, const std::vector<NodalNormal>& normals,
                                                           std::vector<FacetCoupling>& couplings) const {
  std::size_t used = 0;
  std::vector<NearFacet> masters;
  for (std::size_t f = 0; f < slave.facets.size(); ++f) {
    const auto& nodes = slave.facets[f];
    const std::array<Eigen::Vector2d, 2> a = {x[nodes[0]], x[nodes[1]]};
    const double longest_distance = generous((a[1] - a[0]).norm());
    masters.clear();
    for (const auto& facet : candidates[f]) {
      const double distance = segment_distance(a, {x[facet[0]], x[facet[1]]});
      if (distance <= longest_distance) masters.push_back({facet, distance});
    }
    SlaveFacetData data;
    data.nodes = nodes;
    data.weights = slave.facet_weights[f];
    for (int j = 0; j < 2; ++j) {
      data.normals[j] = &normals[nodes[j]];
      data.carries[j] = slave.carries[nodes[j]];
    }
    if (used == couplings.size()) couplings.emplace_back();
    used += integrator.integrate(data, masters, reach, x, derivatives, couplings[used]);
  }
  return used;
}

std::size_t MortarInterface::Implementation::couple_nodes(const Positions& x, bool derivatives, const std::vector<NodalNormal>& normals,
                                                          std::vector<FacetCoupling>& couplings) const {
  std::size_t used = 0;
  for (std::size_t s = 0; s < slave.owned.size(); ++s) {
    if (!slave.owned[s].carries_multiplier) continue;
    if (used == couplings.size()) couplings.emplace_back();
    used += couple_node({slave.owned[s].local_node, &slave.stencils[s], &normals[s]}, met[s], reach, x, measure, options.share, derivatives,
                        couplings[used]);
  }
  return used;
}

void MortarInterface::evaluate(const MultiVector& x, bool derivatives, std::vector<FacetCoupling>& couplings, std::vector<NodalNormal>& normals,
                               std::optional<StepFailure>& failure) const {
  const Implementation& self = *implementation_;
  const SlaveSurface2d& slave = self.slave;
  const auto view = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  Positions positions(view.extent(0));
  for (std::size_t n = 0; n < positions.size(); ++n) positions[n] = {view(n, 0), view(n, 1)};

  normals.resize(slave.nodes_with_normal);
  for (std::size_t n = 0; n < slave.nodes_with_normal; ++n)
    if (!average_normal(slave.stencils[n], positions, derivatives, normals[n]) && !failure)
      failure = StepFailure(
          FailureKind::inverted_facet,
          fmt::format("the slave surface has no normal at node {}: a facet lost its length, or facets folded onto one another", slave.node_ids[n]));
  if (derivatives && self.options.linearisation == Linearisation::frozen_normals)
    for (NodalNormal& normal : normals) normal.derivative.setZero();
  for (std::size_t n = 0; n < positions.size() && !failure; ++n)
    if (!positions[n].allFinite()) failure = StepFailure(FailureKind::not_finite, "a position on the contact surfaces is not a number");
  std::size_t used = 0;
  if (!failure)
    used = self.options.coupling == Coupling::node_to_segment ? self.couple_nodes(positions, derivatives, normals, couplings)
                                                              : self.couple_facets(positions, derivatives, normals, couplings);
  couplings.resize(used);
  normals.resize(slave.owned.size());
}

}  // namespace mortise
