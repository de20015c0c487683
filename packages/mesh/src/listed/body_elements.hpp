#pragma once
// The elements of a body of a mesh file, while they are sorted out.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "mortise/mesh/listed_complex.hpp"

namespace mortise {

/// Elements part by part with the nodes of each.
struct BodyElements {
  std::vector<BodyPart> parts;
  std::vector<std::int64_t> offsets{0};  ///< [elements + 1] into `nodes`
  std::vector<std::int32_t> nodes;       ///< in the order of the shape
  std::vector<std::int64_t> labels;      ///< [elements] numbers in the file

  std::int32_t size() const { return static_cast<std::int32_t>(labels.size()); }
  const std::int32_t* nodes_of(std::int32_t element) const { return nodes.data() + offsets[element]; }
  const CellTopology& cell(std::int32_t element) const {
    std::size_t part = 0;
    while (element >= parts[part].elements) element -= static_cast<std::int32_t>(parts[part++].elements);
    return topology(parts[part].shape);
  }
};

/// A side of an element, or the element itself if it is a facet of a surface: then `side` is the_cell_itself.
struct ElementSide {
  std::int32_t element = 0, side = 0;
};

inline CellShape shape_of_side(const BodyElements& elements, const ElementSide& side) {
  const CellTopology& cell = elements.cell(side.element);
  if (side.side != the_cell_itself) return cell.sides[static_cast<std::size_t>(side.side)].shape;
  std::int32_t first = 0;
  for (const BodyPart& part : elements.parts)
    if (first += static_cast<std::int32_t>(part.elements); side.element < first) return part.shape;
  throw std::logic_error("an element that no part has");
}

/// In the order of the side's shape.
inline std::vector<std::int32_t> nodes_of_side(const BodyElements& elements, const ElementSide& side) {
  const std::int32_t* nodes = elements.nodes_of(side.element);
  const CellTopology& cell = elements.cell(side.element);
  if (side.side == the_cell_itself) return {nodes, nodes + cell.nodes};
  std::vector<std::int32_t> result;
  for (const int a : cell.sides[static_cast<std::size_t>(side.side)].nodes) result.push_back(nodes[a]);
  return result;
}

}  // namespace mortise
