#include "fields/exodus_shapes.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace mortise {
namespace {

// Exodus has the upright edges of a hexahedron before those of its top.
constexpr std::array<std::array<int, 2>, 12> hexahedron_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}};

bool same_ends(const std::array<int, 2>& a, const std::array<int, 2>& b) { return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]); }

}  // namespace

std::string exodus_name(CellShape shape, int dimension) {
  const CellTopology& cell = topology(shape);
  const std::string nodes = std::to_string(cell.nodes);
  if (cell.dimension == 1) return "BAR" + nodes;
  if (cell.dimension == 3) return (cell.corners == 4 ? "TETRA" : cell.corners == 5 ? "PYRAMID" : cell.corners == 6 ? "WEDGE" : "HEX") + nodes;
  if (cell.corners == 3) return (dimension == 3 ? "TRISHELL" : "TRI") + nodes;
  return (dimension == 3 ? "SHELL" : "QUAD") + nodes;
}

std::vector<int> exodus_order(CellShape shape) {
  const CellTopology& cell = topology(shape);
  std::vector<int> order(static_cast<std::size_t>(cell.nodes));
  std::iota(order.begin(), order.end(), 0);
  // XDMF's wedges have bottom and top exchanged; Exodus has the upright edges before those of the top.
  if (shape == CellShape::wedge6) return {3, 4, 5, 0, 1, 2};
  if (shape == CellShape::wedge15) return {3, 4, 5, 0, 1, 2, 9, 10, 11, 12, 13, 14, 6, 7, 8};
  if (cell.dimension != 3 || cell.corners != 8 || cell.mid_side_nodes() == 0) return order;
  for (std::size_t k = 0; k < hexahedron_edges.size(); ++k) {
    const auto edge = std::find_if(cell.edges.begin(), cell.edges.end(), [&](const auto& one) { return same_ends(one, hexahedron_edges[k]); });
    order[8 + k] = cell.corners + static_cast<int>(edge - cell.edges.begin());
  }
  return order;
}

}  // namespace mortise
