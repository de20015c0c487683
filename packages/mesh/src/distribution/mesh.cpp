#include "mortise/mesh/mesh.hpp"

#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {

std::vector<LocalOrdinal> Mesh::side_nodes(const Side& side) const {
  const auto& block = blocks[side.block];
  const LocalOrdinal* nodes = block.nodes(side.element);
  if (side.side == the_cell_itself) return {nodes, nodes + block.nodes_per_element};
  const auto& places = topology(block.shape).sides[side.side].nodes;
  std::vector<LocalOrdinal> result;
  result.reserve(places.size());
  for (const int a : places) result.push_back(nodes[a]);
  return result;
}

CellShape Mesh::side_shape(const Side& side) const {
  const CellShape shape = blocks[side.block].shape;
  return side.side == the_cell_itself ? shape : topology(shape).sides[side.side].shape;
}

}  // namespace mortise
