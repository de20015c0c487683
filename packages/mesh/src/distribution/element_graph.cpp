#include "distribution/element_graph.hpp"

#include <memory>
#include <stdexcept>

#include "distribution/facing_elements.hpp"

namespace mortise {
namespace {

/// Cost of a cut between elements that face one another, where one between elements with a side in common costs 1. More leaves METIS, which
/// balances two weights, with rougher parts on many ranks.
constexpr idx_t weight_across_contact = 2;

struct MetisFree {
  void operator()(idx_t* memory) const { METIS_Free(memory); }
};

struct DualGraph {
  std::unique_ptr<idx_t, MetisFree> offsets, neighbours;
};

/// Elements that share two corners in 2D, or three in 3D, share a side.
DualGraph dual_graph(const BodySet& bodies) {
  idx_t elements = static_cast<idx_t>(bodies.element_count()), nodes = static_cast<idx_t>(bodies.node_count());
  std::vector<idx_t> element_offsets{0}, element_nodes;
  for (idx_t e = 0; e < elements; ++e) {
    const auto ids = bodies.element_nodes(e);
    element_nodes.insert(element_nodes.end(), ids.begin(), ids.begin() + bodies.cell_of(e).corners);
    element_offsets.push_back(static_cast<idx_t>(element_nodes.size()));
  }
  idx_t shared = bodies.dimension(), numbering = 0, *rows = nullptr, *columns = nullptr;
  if (METIS_MeshToDual(&elements, &nodes, element_offsets.data(), element_nodes.data(), &shared, &numbering, &rows, &columns) != METIS_OK)
    throw std::runtime_error("METIS could not build the graph of elements");
  return {std::unique_ptr<idx_t, MetisFree>(rows), std::unique_ptr<idx_t, MetisFree>(columns)};
}

}  // namespace

ElementGraph element_graph(const BodySet& bodies, const std::vector<std::vector<bool>>& is_contact) {
  const DualGraph dual = dual_graph(bodies);
  const auto elements = static_cast<std::size_t>(bodies.element_count());
  std::vector<std::vector<idx_t>> across(elements);
  for (const auto& [first, second] : facing_elements(bodies, is_contact)) {
    across[first].push_back(static_cast<idx_t>(second));
    across[second].push_back(static_cast<idx_t>(first));
  }
  ElementGraph graph;
  graph.offsets.push_back(0);
  for (std::size_t e = 0; e < elements; ++e) {
    const idx_t *first = dual.neighbours.get() + dual.offsets.get()[e], *last = dual.neighbours.get() + dual.offsets.get()[e + 1];
    graph.neighbours.insert(graph.neighbours.end(), first, last);
    graph.neighbours.insert(graph.neighbours.end(), across[e].begin(), across[e].end());
    graph.weights.insert(graph.weights.end(), static_cast<std::size_t>(last - first), 1);
    graph.weights.insert(graph.weights.end(), across[e].size(), weight_across_contact);
    graph.offsets.push_back(static_cast<idx_t>(graph.neighbours.size()));
  }
  return graph;
}

}  // namespace mortise
