#include "mortise/mesh/curve_complex.hpp"

#include <algorithm>

#include "generators/interval.hpp"

namespace mortise {

CurveComplex::CurveComplex(std::vector<Point> corners, std::vector<Edge> edges, const std::vector<std::string>& names, Placement placement)
    : corners_(std::move(corners)), edges_(std::move(edges)), placement_(placement) {
  edge_nodes_.push_back(static_cast<GlobalOrdinal>(corners_.size()));
  edge_cells_.push_back(0);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    edge_nodes_.push_back(edge_nodes_.back() + edges_[e].spacing.cells() - 1);
    edge_cells_.push_back(edge_cells_.back() + edges_[e].spacing.cells());
    const auto name = std::find(side_names_.begin(), side_names_.end(), names.at(e));
    edge_sides_.push_back(static_cast<int>(name - side_names_.begin()));
    if (name == side_names_.end()) side_names_.push_back(names[e]);
  }
}

Point CurveComplex::coordinate(GlobalOrdinal node) const {
  if (node < edge_nodes_.front()) return placement_(corners_[node]);
  const int e = interval(edge_nodes_, node);
  return on_edge(e, static_cast<int>(node - edge_nodes_[e]) + 1);
}

Point CurveComplex::on_edge(int e, int i) const { return placement_(edge_point(edges_[e], corners_, 2 * i)); }

CellNodes CurveComplex::element_nodes(GlobalOrdinal element) const {
  const int e = interval(edge_cells_, element), inside = static_cast<int>(element - edge_cells_[e]);
  const auto node = [&](int index) -> GlobalOrdinal {
    if (index == 0) return edges_[e].start;
    return index == edges_[e].spacing.cells() ? edges_[e].end : edge_nodes_[e] + index - 1;
  };
  return {node(inside), node(inside + 1)};
}

std::vector<GlobalOrdinal> CurveComplex::elements_of_node(GlobalOrdinal node) const {
  std::vector<GlobalOrdinal> elements;
  if (node >= edge_nodes_.front()) {
    const int e = interval(edge_nodes_, node);
    const GlobalOrdinal before = edge_cells_[e] + (node - edge_nodes_[e]);
    return {before, before + 1};
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (edges_[e].start == node) elements.push_back(edge_cells_[e]);
    if (edges_[e].end == node) elements.push_back(edge_cells_[e + 1] - 1);
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

std::vector<SurfaceSide> CurveComplex::surface_sides(GlobalOrdinal element) const {
  return {{the_cell_itself, edge_sides_[interval(edge_cells_, element)]}};
}

std::vector<int> CurveComplex::sides_of_node(GlobalOrdinal node) const {
  std::vector<int> names;
  for (const GlobalOrdinal element : elements_of_node(node)) names.push_back(edge_sides_[interval(edge_cells_, element)]);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace mortise
