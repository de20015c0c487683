// Size of a mesh over all ranks.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mortise/mesh/build_mesh.hpp"

namespace mortise {
namespace {

double squared_distance(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  return (x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]);
}

}  // namespace

MeshSize mesh_size(const Mesh& mesh) {
  MeshSize size;
  size.nodes = static_cast<GlobalOrdinal>(mesh.owned_nodes->getGlobalNumElements());
  std::vector<GlobalOrdinal> local;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Minima over the ranks: of x, y, z, -x, -y, -z and of the squared lengths of edges.
  std::array<double, 7> low, global_low;
  low.fill(infinity);
  for (LocalOrdinal node = 0; node < mesh.owned_body_count(); ++node)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], mesh.coordinates[node][i]);
      low[3 + i] = std::min(low[3 + i], -mesh.coordinates[node][i]);
    }
  for (const auto& block : mesh.blocks) {
    local.push_back(block.owned);
    const auto& edges = topology(block.shape).edges;
    for (LocalOrdinal e = 0; e < block.owned; ++e)
      for (const auto& [a, b] : edges)
        low[6] = std::min(low[6], squared_distance(mesh.coordinates[block.nodes(e)[a]], mesh.coordinates[block.nodes(e)[b]]));
  }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, static_cast<int>(low.size()), low.data(), global_low.data());
  size.elements_of_block.resize(local.size());
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, static_cast<int>(local.size()), local.data(), size.elements_of_block.data());
  for (const auto count : size.elements_of_block) size.elements += count;
  size.length = std::hypot(std::hypot(global_low[3] + global_low[0], global_low[4] + global_low[1]), global_low[5] + global_low[2]);
  size.shortest_side = std::sqrt(global_low[6]);
  return size;
}

}  // namespace mortise
