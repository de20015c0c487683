#include "scale/scale_plan.hpp"

#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <set>

#include "mortise/mesh/sets.hpp"
#include "mortise/mortar/facet_partition.hpp"
#include "mortise/mortar/mortar_interface.hpp"
#include "mortise/simulation/model/memory_estimate.hpp"
#include "mortise/simulation/model/mesh_limits.hpp"
#include "mortise/simulation/scene/scene_bodies.hpp"

namespace mortise {
/// A slave facet of the plan.
struct PlannedFacet {
  SurfaceFacet nodes;
  long segments = 0;
  double bytes = 0.0;  ///< of the message in which its coupling travels
  PartitionedFacet place;
};

namespace {

/// The facets that overlap a master facet in the reference configuration, by the search and the integrals of runs.
std::vector<PlannedFacet> slave_facets(const Mesh& mesh, const Scene& scene, const Named<ContactPairOptions>& pair,
                                       const Located<std::string>& slave_set, const Located<std::string>& master_set) {
  const int dim = mesh.dimension;
  const auto reference = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(dim)));
  const auto fixed = rcp(new MultiVector(mesh.owned_nodes, static_cast<std::size_t>(dim)));  // which nodes carry multipliers changes no overlap
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node)
    for (int i = 0; i < dim; ++i) reference->replaceLocalValue(node, i, mesh.coordinates[node][i]);
  MortarOptions options = pair.value.contact.mortar;
  options.coupling = pair.value.contact.formulation.options->coupling();
  const SurfaceFacets slave = facets_at_owned_nodes(mesh, require_side_set(mesh, slave_set));
  const SurfaceFacets master = facets_of_owned_elements(mesh, require_side_set(mesh, master_set));
  MortarInterface interface(mesh.owned_nodes, reference, fixed, slave, master, {scene.kinematics == Kinematics::axisymmetric, scene.thickness},
                            options, pair.place);
  interface.search(*reference);
  MultiVector x(interface.local_nodes(), static_cast<std::size_t>(dim));
  x.doImport(*reference, Import(mesh.owned_nodes, interface.local_nodes()), Tpetra::REPLACE);
  std::vector<FacetCoupling> couplings;
  std::vector<NodalNormal> normals;
  std::optional<StepFailure> failure;
  interface.evaluate(x, false, couplings, normals, failure);
  throw_if_any(*mesh.comm, failure);

  std::vector<PlannedFacet> facets;
  for (std::size_t c = 0; c < interface.segments().size(); ++c) {
    const FacetCoupling& coupling = couplings[c];
    PlannedFacet& facet = facets.emplace_back();
    std::set<LocalOrdinal> columns(coupling.master.begin(), coupling.master.end());
    for (const LocalOrdinal node : coupling.slave) {
      facet.nodes.push_back(interface.local_nodes()->getGlobalElement(node));
      columns.insert(normals[node].columns.begin(), normals[node].columns.end());
      const auto& X = mesh.coordinates[mesh.local_nodes->getLocalElement(facet.nodes.back())];
      for (int i = 0; i < dim; ++i) facet.place.centre[i] += X[i] / static_cast<double>(coupling.slave.size());
    }
    facet.segments = static_cast<long>(interface.segments()[c]);
    facet.place.work = static_cast<double>(facet.segments);
    facet.bytes = static_cast<double>(coupling_bytes(coupling.slave.size(), coupling.master.size(), columns.size(), dim));
  }
  return facets;
}

/// Ranks that own nodes of a facet, ascending.
std::vector<int> owners_of(const PlannedFacet& facet, const MeshPlan& plan) {
  std::vector<int> owners;
  for (const GlobalOrdinal node : facet.nodes) owners.push_back(plan.owner_of_node[node]);
  std::sort(owners.begin(), owners.end());
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  return owners;
}

double imbalance(const std::vector<PlannedFacet>& facets, const std::vector<int>& rank_of, int ranks) {
  std::vector<double> work(static_cast<std::size_t>(ranks), 0.0);
  for (std::size_t f = 0; f < facets.size(); ++f) work[rank_of[f]] += facets[f].place.work;
  return largest_over_mean(work);
}

/// Gives the facets of a pair to the ranks, as FacetDistribution does.
PairPlan share_out(const RCP<const Communicator>& comm, const std::vector<PlannedFacet>& facets, const MeshPlan& meshes, double bound,
                   std::vector<RankPlan>& ranks) {
  const auto count = static_cast<int>(ranks.size());
  PairPlan pair;
  std::vector<int> rank_of;
  std::vector<PartitionedFacet> places;
  for (const PlannedFacet& facet : facets) {
    rank_of.push_back(home_of(facet.nodes, owners_of(facet, meshes)));
    places.push_back(facet.place);
    ++pair.facets;
    pair.segments += facet.segments;
    pair.most_segments = std::max(pair.most_segments, facet.segments);
  }
  pair.imbalance_as_owned = pair.imbalance = imbalance(facets, rank_of, count);
  if (pair.imbalance > bound) {
    const std::vector<int> other = partition_facets(comm, places, count);
    const double then = imbalance(facets, other, count);
    pair.is_moved = worth_moving(pair.imbalance, then, bound);
    if (pair.is_moved) {
      rank_of = other;
      pair.imbalance = then;
    }
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    ++ranks[rank_of[f]].facets;
    ranks[rank_of[f]].segments += facets[f].segments;
    for (const int owner : owners_of(facets[f], meshes))
      if (owner != rank_of[f]) ranks[owner].coupling_bytes[rank_of[f]] += facets[f].bytes;
  }
  return pair;
}

// Memory that grows with the mesh: linear systems, nodes and elements with their sets and maps, couplings.
double memory_mib(const RankPlan& rank, int dimension, int nodes_per_element, bool parallel) {
  constexpr double bytes_of_node = 150.0, bytes_of_element = 30.0;
  const auto& mesh = rank.mesh;
  const double elements = static_cast<double>(mesh.elements + mesh.ghost_elements), nodes = static_cast<double>(mesh.nodes + mesh.ghost_nodes);
  double bytes = multigrid_bytes({dimension, static_cast<double>(mesh.nodes), static_cast<double>(mesh.node_pairs), parallel}) +
                 bytes_of_node * nodes + (bytes_of_element + static_cast<double>(sizeof(LocalOrdinal)) * nodes_per_element) * elements;
  for (const auto& [from, couplings] : rank.coupling_bytes) bytes += couplings;
  return bytes / (1024.0 * 1024.0);
}

}  // namespace

std::size_t RankPlan::neighbours() const {
  std::set<int> all;
  for (const auto* from : {&vector_bytes, &coupling_bytes})
    for (const auto& [rank, bytes] : *from) all.insert(rank);
  return all.size();
}

double PairPlan::least_imbalance(int ranks) const {
  return segments > 0 ? std::max(1.0, static_cast<double>(most_segments) * ranks / static_cast<double>(segments)) : 1.0;
}

/// A contact pair's slave facets, and what their distribution is asked for.
struct PlannedPair {
  std::string name;
  double balance = 1.0;
  std::vector<PlannedFacet> facets;
};

struct ScalePlanner::Model {
  RCP<const Communicator> comm;
  std::vector<BodyDescription> bodies;
  std::vector<std::string> sides;
  int dimension = 0, nodes_per_element = 0;
  std::vector<PlannedPair> pairs;
};

ScalePlanner::ScalePlanner(const RCP<const Communicator>& comm, const Scene& scene, int most_ranks) {
  auto model = std::make_unique<Model>();
  model->comm = comm;
  model->bodies = body_descriptions(*comm, scene);
  refuse_too_large_to_plan(*comm, model->bodies, most_ranks);
  model->sides = contact_sides(scene);
  const RCP<Mesh> mesh = build_mesh(comm, model->bodies, model->sides);
  for (const auto& set : scene.sets) add_set(*mesh, set);
  model->dimension = mesh->dimension;
  for (const Block& block : mesh->blocks) model->nodes_per_element = std::max(model->nodes_per_element, block.nodes_per_element);
  for (const auto& pair : scene.contact) {
    const auto add_pass = [&](const std::string& name, const Located<std::string>& slave, const Located<std::string>& master) {
      model->pairs.push_back({name, pair.value.contact.mortar.balance, slave_facets(*mesh, scene, pair, slave, master)});
    };
    add_pass(pair.name, pair.value.slave, pair.value.master);
    if (pair.value.contact.formulation.options->two_pass()) add_pass(pair.name + ", second pass", pair.value.master, pair.value.slave);
  }
  model_ = std::move(model);
}

ScalePlanner::~ScalePlanner() = default;

ScalePlan ScalePlanner::plan(int ranks) const {
  ScalePlan plan;
  plan.dimension = model_->dimension;
  const MeshPlan meshes = plan_mesh(model_->bodies, model_->sides, ranks);
  for (const MeshShare& share : meshes.shares) {
    RankPlan& rank = plan.ranks.emplace_back();
    rank.mesh = share;
    for (const auto& [owner, nodes] : share.ghosts_from) rank.vector_bytes[owner] = static_cast<double>(sizeof(double) * plan.dimension * nodes);
  }
  for (const PlannedPair& pair : model_->pairs) {
    plan.pairs.push_back(share_out(model_->comm, pair.facets, meshes, pair.balance, plan.ranks));
    plan.pairs.back().name = pair.name;
  }
  for (RankPlan& rank : plan.ranks) rank.memory_mib = memory_mib(rank, plan.dimension, model_->nodes_per_element, ranks > 1);
  return plan;
}

}  // namespace mortise
