#include "surfaces/sharp_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "mortise/mortar/quadratic_facet.hpp"
#include "surfaces/facet_kinks.hpp"

namespace mortise {
namespace {

/// A facet as one of its edges sees it.
struct FacetAtEdge {
  Eigen::Vector3d normal;
  LocalOrdinal beside, middle;  ///< middle: of the edge, -1: none
  LocalOrdinal block;
  bool is_in_set;
};

using EdgeKey = std::pair<LocalOrdinal, LocalOrdinal>;

std::map<EdgeKey, std::vector<FacetAtEdge>> facets_at_edges(const Mesh& mesh, std::size_t body, const SideSet& set, const PlaceOfNode& at) {
  const auto key = [](const Side& side) { return std::tuple(side.block, side.element, side.side); };
  std::set<std::tuple<LocalOrdinal, LocalOrdinal, int>> members;
  for (const Side& side : set.sides) members.insert(key(side));
  std::map<EdgeKey, std::vector<FacetAtEdge>> result;
  for (const Side& side : whole_surface(mesh, body).sides) {
    const std::vector<LocalOrdinal> nodes = mesh.side_nodes(side);
    const std::size_t corners = facet_corners(3, nodes.size());
    const Eigen::Vector3d normal = facet_normal(3, places_of(mesh, side, at));
    for (std::size_t k = 0; k < corners; ++k) {
      const LocalOrdinal a = nodes[k], b = nodes[(k + 1) % corners];
      result[std::minmax(a, b)].push_back(
          {normal, nodes[(k + 2) % corners], nodes.size() > corners ? nodes[corners + k] : -1, side.block, members.count(key(side)) > 0});
    }
  }
  return result;
}

bool is_sharp(const std::vector<FacetAtEdge>& facets, const Eigen::Vector3d& on_edge, const PlaceOfNode& at) {
  if (facets.size() != 2 || !(facets[0].is_in_set || facets[1].is_in_set)) return false;
  const bool is_convex = (at(facets[1].beside) - on_edge).dot(facets[0].normal) < 0.0;
  return is_convex && facets[0].normal.dot(facets[1].normal) < std::cos(kink_angle);
}

}  // namespace

// All facets around an owned node are on its rank, so both of an edge with an owned end.
SharpEdges sharp_edges(const Mesh& mesh, std::size_t body, const SideSet& set) {
  const PlaceOfNode at = reference_places(mesh);
  SharpEdges result;
  std::map<LocalOrdinal, std::vector<LocalOrdinal>> around;  // of owned nodes: where edges lead to
  for (const auto& [ends, facets] : facets_at_edges(mesh, body, set, at)) {
    if (!is_sharp(facets, at(ends.first), at)) continue;
    std::vector<LocalOrdinal> line{ends.first, ends.second};
    if (facets[0].middle >= 0) line.insert(line.begin() + 1, facets[0].middle);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      std::array<LocalOrdinal, 2> piece{line[k], line[k + 1]};
      if (mesh.local_nodes->getGlobalElement(piece[0]) > mesh.local_nodes->getGlobalElement(piece[1])) std::swap(piece[0], piece[1]);
      if (piece[0] < mesh.owned_count()) result.pieces.push_back({piece, {facets[0].beside, facets[1].beside}, facets[0].block});
      for (const int e : {0, 1})
        if (piece[static_cast<std::size_t>(e)] < mesh.owned_count())
          around[piece[static_cast<std::size_t>(e)]].push_back(piece[static_cast<std::size_t>(1 - e)]);
    }
  }
  for (const auto& [node, leads_to] : around) {
    EdgeNode& edge_node = result.nodes.emplace_back(EdgeNode{node, {-1, -1}});
    if (leads_to.size() != 2) continue;
    const Eigen::Vector3d one = (at(leads_to[0]) - at(node)).normalized(), other = (at(node) - at(leads_to[1])).normalized();
    if (one.dot(other) > std::cos(kink_angle)) edge_node.next = {leads_to[0], leads_to[1]};
  }
  return result;
}

}  // namespace mortise
