#include "placement/reflected_cell.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace mortise {
namespace {

/// Reflection of a place in the reference cell. Cells with a right angle between the first two directions are symmetric in these. Cubes, squares and
/// lines have the first direction turned round, which keeps the plane across it.
template <class Cell>
std::array<double, Cell::dimension> reflected(std::array<double, Cell::dimension> xi) {
  constexpr bool is_symmetric_in_two = Cell::dimension > 1 && Cell::centroid[0] != 0.0;
  if constexpr (is_symmetric_in_two)
    std::swap(xi[0], xi[1]);
  else
    xi[0] = -xi[0];
  return xi;
}

template <class Cell>
ReflectedCell make_reflected_cell(const CellTopology& topology) {
  ReflectedCell result;
  for (int a = 0; a < Cell::nodes; ++a) {
    const auto place = reflected<Cell>(Cell::node_positions[a]);
    const auto found = std::find_if(Cell::node_positions.begin(), Cell::node_positions.end(), [&](const auto& other) {
      double apart = 0.0;
      for (int i = 0; i < Cell::dimension; ++i) apart = std::max(apart, std::abs(other[i] - place[i]));
      return apart < 1e-12;
    });
    if (found == Cell::node_positions.end()) throw std::logic_error("a cell shape without the symmetry of its reference cell");
    result.nodes.push_back(static_cast<int>(found - Cell::node_positions.begin()));
  }
  // A side keeps its nodes: it has the places that they have now.
  const auto sorted = [](std::vector<int> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  for (const CellSide& side : topology.sides) {
    std::vector<int> now;
    for (const int node : side.nodes)
      now.push_back(static_cast<int>(std::find(result.nodes.begin(), result.nodes.end(), node) - result.nodes.begin()));
    const auto found =
        std::find_if(topology.sides.begin(), topology.sides.end(), [&](const CellSide& other) { return sorted(other.nodes) == sorted(now); });
    if (found == topology.sides.end()) throw std::logic_error("a side of a cell that its reflection does not have");
    result.sides.push_back(static_cast<int>(found - topology.sides.begin()));
  }
  return result;
}

}  // namespace

const ReflectedCell& reflected_cell(CellShape shape) {
  static const std::map<CellShape, ReflectedCell> cells = [] {
    std::map<CellShape, ReflectedCell> all;
    visit_each_cell([&](auto cell) {
      using Cell = decltype(cell);
      all.emplace(shape_of<Cell>, make_reflected_cell<Cell>(topology(shape_of<Cell>)));
    });
    return all;
  }();
  return cells.at(shape);
}

}  // namespace mortise
