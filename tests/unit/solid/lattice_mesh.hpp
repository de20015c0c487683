#pragma once
// Meshes of every cell shape on one rank: a lattice of boxes mapped to any positions.

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

using LatticePoint = std::array<int, 3>;  ///< corners of boxes at even coordinates

/// Corners of the lowest box, in the order of a hexahedron.
inline const std::vector<LatticePoint> lowest_box{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};

/// The corners of the lowest box's cells. Triangles halve it, and so do wedges; pyramids have its sides as bases, with their apexes in its middle;
/// tetrahedra are Kuhn's six. Diagonals of cut sides start at the corner where all coordinates are lowest.
inline std::vector<std::vector<LatticePoint>> cells_of_a_box(CellShape shape) {
  const CellTopology& cell = topology(shape);
  const auto& box = lowest_box;
  if (cell.corners == 8) return {box};
  if (cell.dimension == 2 && cell.corners == 4) return {{box[0], box[1], box[2], box[3]}};
  if (cell.dimension == 2) return {{box[0], box[1], box[2]}, {box[0], box[2], box[3]}};
  if (cell.corners == 6) return {{box[0], box[1], box[2], box[4], box[5], box[6]}, {box[0], box[2], box[3], box[4], box[6], box[7]}};
  if (cell.corners == 5) {
    std::vector<std::vector<LatticePoint>> pyramids;
    for (const CellSide& side : topology(CellShape::hexahedron8).sides) {
      std::vector<LatticePoint> corners;
      for (int a = 3; a >= 0; --a) corners.push_back(box[side.nodes[a]]);  // counterclockwise seen from inside
      corners.push_back({1, 1, 1});
      pyramids.push_back(corners);
    }
    return pyramids;
  }
  std::vector<std::vector<LatticePoint>> tetrahedra;
  LatticePoint way{0, 1, 2};
  do {
    std::vector<LatticePoint> corners{{0, 0, 0}};
    for (const int direction : way) {
      corners.push_back(corners.back());
      corners.back()[direction] += 2;
    }
    const bool even = (way[1] - way[0] + 3) % 3 == 1;
    if (!even) std::swap(corners[1], corners[2]);
    tetrahedra.push_back(corners);
  } while (std::next_permutation(way.begin(), way.end()));
  return tetrahedra;
}

/// The unit square or cube, each point s moved to position(s). Sides are "body/left", "body/right" (x) and "body/surface". In 2D there are also
/// "body/bottom", "body/top" (y); in 3D "body/front", "body/back" (y) and "body/bottom", "body/top" (z). Mid-side nodes stay in the middle unless
/// `curved`.
inline RCP<Mesh> make_lattice_mesh(const RCP<const Communicator>& comm, CellShape shape, const std::array<int, 3>& cells,
                                   const std::function<std::array<double, 3>(const std::array<double, 3>&)>& position, bool curved) {
  const CellTopology& cell = topology(shape);
  auto mesh = rcp(new Mesh);
  mesh->dimension = cell.dimension;
  mesh->comm = comm;
  Block block;
  block.shape = shape;
  block.nodes_per_element = cell.nodes;

  std::map<LatticePoint, LocalOrdinal> nodes;
  const auto node_at = [&](const LatticePoint& point, const std::array<double, 3>& X) {
    const auto [entry, is_new] = nodes.try_emplace(point, static_cast<LocalOrdinal>(nodes.size()));
    if (is_new) mesh->coordinates.push_back(X);
    return entry->second;
  };
  const auto map_point = [&](const LatticePoint& point) {
    std::array<double, 3> s{};
    for (int i = 0; i < cell.dimension; ++i) s[i] = point[i] / (2.0 * cells[i]);
    return position(s);
  };
  const std::vector<std::array<std::string, 2>> names =
      cell.dimension == 2
          ? std::vector<std::array<std::string, 2>>{{"body/left", "body/right"}, {"body/bottom", "body/top"}}
          : std::vector<std::array<std::string, 2>>{{"body/left", "body/right"}, {"body/front", "body/back"}, {"body/bottom", "body/top"}};
  const auto add_sides = [&](const std::vector<LatticePoint>& corners) {
    const LocalOrdinal element = block.size() - 1;
    for (int s = 0; s < static_cast<int>(cell.sides.size()); ++s)
      for (int i = 0; i < cell.dimension; ++i)
        for (int end = 0; end < 2; ++end) {
          const CellSide& side = cell.sides[s];
          const bool outer = std::all_of(side.nodes.begin(), side.nodes.begin() + side.corners,
                                         [&](int a) { return corners[a][i] == (end == 0 ? 0 : 2 * cells[i]); });
          if (!outer) continue;
          for (const std::string& name : {names[i][end], std::string("body/surface")}) {
            mesh->side_sets[name].sides.push_back({0, element, s});
            ++mesh->side_sets[name].owned;
          }
        }
  };
  for (int k = 0; k < (cell.dimension == 3 ? cells[2] : 1); ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (auto corners : cells_of_a_box(shape)) {
          for (auto& corner : corners) corner = {corner[0] + 2 * i, corner[1] + 2 * j, corner[2] + 2 * k};
          for (int a = 0; a < cell.nodes; ++a) {
            if (a < cell.corners) {
              block.connectivity.push_back(node_at(corners[a], map_point(corners[a])));
              continue;
            }
            const auto& edge = cell.edges[a - cell.corners];
            const auto &one = corners[edge[0]], &other = corners[edge[1]];
            LatticePoint middle;
            for (int d = 0; d < 3; ++d) middle[d] = (one[d] + other[d]) / 2;
            auto X = map_point(middle);
            if (!curved)
              for (int d = 0; d < 3; ++d) X[d] = 0.5 * (map_point(one)[d] + map_point(other)[d]);
            block.connectivity.push_back(node_at(middle, X));
          }
          block.element_ids.push_back(static_cast<GlobalOrdinal>(block.element_ids.size()));
          add_sides(corners);
        }
  block.owned = block.size();
  mesh->bodies = {{"body", false}};
  mesh->blocks = {block};
  mesh->owned_nodes = mesh->local_nodes = rcp(new Map(nodes.size(), 0, comm));
  mesh->body_of_node.assign(nodes.size(), 0);
  for (const auto& [name, set] : mesh->side_sets) {
    std::set<LocalOrdinal> of_set;
    for (const Side& side : set.sides)
      for (const LocalOrdinal node : mesh->side_nodes(side)) of_set.insert(node);
    mesh->node_sets[name].assign(of_set.begin(), of_set.end());
  }
  for (LocalOrdinal node = 0; node < static_cast<LocalOrdinal>(nodes.size()); ++node) mesh->node_sets["body"].push_back(node);
  return mesh;
}

}  // namespace mortise
