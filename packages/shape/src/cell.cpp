#include "mortise/shape/cell.hpp"

#include <tuple>

namespace mortise {
namespace {

template <class Side>
CellSide side_of(const SideNodes<Side>& side) {
  return {shape_of<Side>, Side::corners, {side.nodes.begin(), side.nodes.end()}};
}

template <class Cell>
CellTopology make_topology() {
  return {Cell::dimension,
          Cell::nodes,
          Cell::corners,
          std::apply([](const auto&... side) { return std::vector<CellSide>{side_of(side)...}; }, Cell::sides),
          {Cell::edges.begin(), Cell::edges.end()}};
}

}  // namespace

const CellTopology& topology(CellShape shape) {
  return visit_cell(shape, [](auto cell) -> const CellTopology& {
    static const CellTopology made = make_topology<decltype(cell)>();
    return made;
  });
}

}  // namespace mortise
