#include "mortise/mesh/mesh.hpp"

namespace mortise {

std::vector<LocalOrdinal> Mesh::side_nodes(const Side& side) const {
  const auto& block = blocks[side.block];
  const LocalOrdinal* nodes = block.nodes(side.element);
  std::vector<LocalOrdinal> result;
  for (const int a : topology(block.shape).sides[side.side]) result.push_back(nodes[a]);
  return result;
}

}  // namespace mortise
