#include "mortise/mesh/mesh_plan.hpp"

#include <algorithm>

#include "distribution/body_set.hpp"
#include "distribution/partition.hpp"

namespace mortise {
namespace {

using Ids = std::vector<GlobalOrdinal>;

void make_unique(Ids& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// One rank's share from the elements and nodes that it owns.
MeshShare share_of(const BodySet& bodies, const MeshPlan& plan, int rank, const Ids& elements, const Ids& nodes) {
  MeshShare share;
  share.elements = static_cast<GlobalOrdinal>(elements.size());
  share.nodes = static_cast<GlobalOrdinal>(nodes.size());
  Ids ghosts, foreign, around;
  const auto add_foreign = [&](GlobalOrdinal element) {
    for (const GlobalOrdinal node : bodies.element_nodes(element))
      if (plan.owner_of_node[node] != rank) foreign.push_back(node);
  };
  for (const GlobalOrdinal element : elements) add_foreign(element);
  for (const GlobalOrdinal node : nodes) {
    around.clear();
    for (const GlobalOrdinal element : bodies.elements_of_node(node)) {
      const auto of_element = bodies.element_nodes(element);
      around.insert(around.end(), of_element.begin(), of_element.end());
      if (plan.rank_of_element[element] != rank) ghosts.push_back(element);
    }
    make_unique(around);
    share.node_pairs += static_cast<GlobalOrdinal>(around.size());
  }
  make_unique(ghosts);
  for (const GlobalOrdinal element : ghosts) add_foreign(element);
  make_unique(foreign);
  share.ghost_elements = static_cast<GlobalOrdinal>(ghosts.size());
  share.ghost_nodes = static_cast<GlobalOrdinal>(foreign.size());
  for (const GlobalOrdinal node : foreign) ++share.ghosts_from[plan.owner_of_node[node]];
  return share;
}

}  // namespace

MeshPlan plan_mesh(const std::vector<BodyDescription>& bodies, const std::vector<std::string>& contact_sides, int ranks) {
  check_bodies(bodies);
  const BodySet set(bodies);
  MeshPlan plan;
  plan.rank_of_element = ranks_of_elements(set, contact_flags(set, bodies, contact_sides), ranks);
  std::vector<Ids> elements(static_cast<std::size_t>(ranks)), nodes(elements.size());
  for (std::size_t e = 0; e < plan.rank_of_element.size(); ++e) elements[plan.rank_of_element[e]].push_back(static_cast<GlobalOrdinal>(e));
  plan.owner_of_node.resize(static_cast<std::size_t>(set.node_count()));
  for (GlobalOrdinal node = 0; node < set.node_count(); ++node) {
    std::vector<int> holders;
    for (const GlobalOrdinal element : set.elements_of_node(node)) holders.push_back(plan.rank_of_element[element]);
    plan.owner_of_node[node] = owner_among(holders);
    nodes[plan.owner_of_node[node]].push_back(node);
  }
  for (int rank = 0; rank < ranks; ++rank) plan.shares.push_back(share_of(set, plan, rank, elements[rank], nodes[rank]));
  return plan;
}

}  // namespace mortise
