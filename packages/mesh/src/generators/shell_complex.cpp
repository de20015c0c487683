#include "mortise/mesh/shell_complex.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "generators/interval.hpp"

namespace mortise {
namespace {

/// Edge e of a patch lies between these corners; along it runs direction e % 2.
constexpr int edge_corners_of_patch[4][2] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}};

std::array<int, 2> at_corner(const ShellComplex::Patch& patch, int corner) {
  return {corner == 1 || corner == 2 ? patch.cells[0] : 0, corner >= 2 ? patch.cells[1] : 0};
}

}  // namespace

ShellComplex::ShellComplex(std::vector<Patch> patches, Position position, SpatialPlacement placement)
    : patches_(std::move(patches)), position_(std::move(position)), placement_(placement) {
  std::map<std::array<int, 2>, int> known;
  for (int p = 0; p < static_cast<int>(patches_.size()); ++p) {
    const Patch& patch = patches_[p];
    for (int corner = 0; corner < 4; ++corner) {
      if (patch.corners[corner] >= static_cast<int>(corner_uses_.size())) corner_uses_.resize(patch.corners[corner] + 1);
      corner_uses_[patch.corners[corner]].push_back({p, at_corner(patch, corner)});
    }
    patch_edges_.emplace_back();
    for (int e = 0; e < 4; ++e) {
      std::array<int, 2> corners{patch.corners[edge_corners_of_patch[e][0]], patch.corners[edge_corners_of_patch[e][1]]};
      std::sort(corners.begin(), corners.end());
      const auto [found, is_new] = known.insert({corners, static_cast<int>(edges_.size())});
      if (is_new) edges_.push_back({corners, patch.cells[e % 2], {}});
      Edge& edge = edges_[found->second];
      if (edge.cells != patch.cells[e % 2]) throw std::logic_error("patches that share an edge have to have the same cells along it");
      edge.uses.push_back({p, e});
      patch_edges_.back()[e] = found->second;
    }
    patch_cells_.push_back(patch_cells_.back() + static_cast<GlobalOrdinal>(patch.cells[0]) * patch.cells[1]);
    const auto name = std::find(side_names_.begin(), side_names_.end(), patch.side);
    patch_sides_.push_back(static_cast<int>(name - side_names_.begin()));
    if (name == side_names_.end()) side_names_.push_back(patch.side);
  }
  edge_nodes_.push_back(static_cast<GlobalOrdinal>(corner_uses_.size()));
  for (const Edge& edge : edges_) edge_nodes_.push_back(edge_nodes_.back() + edge.cells - 1);
  patch_nodes_.push_back(edge_nodes_.back());
  for (const Patch& patch : patches_)
    patch_nodes_.push_back(patch_nodes_.back() + static_cast<GlobalOrdinal>(patch.cells[0] - 1) * (patch.cells[1] - 1));
}

ShellComplex::GridPoint ShellComplex::on_edge(int patch, int e, int from_lower_corner) const {
  const Patch& one = patches_[patch];
  const auto& [start, end] = edge_corners_of_patch[e];
  const int direction = e % 2, cells = one.cells[direction];
  GridPoint point{patch, at_corner(one, start)};
  point.at[direction] = one.corners[start] < one.corners[end] ? from_lower_corner : cells - from_lower_corner;
  return point;
}

GlobalOrdinal ShellComplex::node_at(const GridPoint& point) const {
  const Patch& patch = patches_[point.patch];
  const auto& [i, j] = point.at;
  const bool at_end_i = i == 0 || i == patch.cells[0], at_end_j = j == 0 || j == patch.cells[1];
  if (at_end_i && at_end_j) return patch.corners[j == 0 ? (i == 0 ? 0 : 1) : (i == 0 ? 3 : 2)];
  if (at_end_i || at_end_j) {
    const int e = at_end_j ? (j == 0 ? 0 : 2) : (i == 0 ? 3 : 1), along = point.at[e % 2], edge = patch_edges_[point.patch][e];
    const bool forward = patch.corners[edge_corners_of_patch[e][0]] == edges_[edge].corners[0];
    return edge_nodes_[edge] + (forward ? along : edges_[edge].cells - along) - 1;
  }
  return patch_nodes_[point.patch] + (i - 1) + static_cast<GlobalOrdinal>(patch.cells[0] - 1) * (j - 1);
}

std::vector<ShellComplex::GridPoint> ShellComplex::grid_points(GlobalOrdinal node) const {
  if (node < edge_nodes_.front()) return corner_uses_[node];
  if (node < patch_nodes_.front()) {
    const int edge = interval(edge_nodes_, node);
    std::vector<GridPoint> points;
    for (const auto& [patch, e] : edges_[edge].uses) points.push_back(on_edge(patch, e, static_cast<int>(node - edge_nodes_[edge]) + 1));
    return points;
  }
  const int patch = interval(patch_nodes_, node), inside = static_cast<int>(node - patch_nodes_[patch]), row = patches_[patch].cells[0] - 1;
  return {{patch, {inside % row + 1, inside / row + 1}}};
}

CellNodes ShellComplex::element_nodes(GlobalOrdinal element) const {
  const int patch = interval(patch_cells_, element), inside = static_cast<int>(element - patch_cells_[patch]), row = patches_[patch].cells[0];
  const int i = inside % row, j = inside / row;
  return {node_at({patch, {i, j}}), node_at({patch, {i + 1, j}}), node_at({patch, {i + 1, j + 1}}), node_at({patch, {i, j + 1}})};
}

std::vector<GlobalOrdinal> ShellComplex::elements_of_node(GlobalOrdinal node) const {
  std::vector<GlobalOrdinal> elements;
  for (const auto& [patch, at] : grid_points(node)) {
    const auto& cells = patches_[patch].cells;
    for (int j = std::max(0, at[1] - 1); j <= std::min(at[1], cells[1] - 1); ++j)
      for (int i = std::max(0, at[0] - 1); i <= std::min(at[0], cells[0] - 1); ++i)
        elements.push_back(patch_cells_[patch] + i + static_cast<GlobalOrdinal>(cells[0]) * j);
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

std::vector<SurfaceSide> ShellComplex::surface_sides(GlobalOrdinal element) const {
  return {{the_cell_itself, patch_sides_[interval(patch_cells_, element)]}};
}

std::vector<int> ShellComplex::sides_of_node(GlobalOrdinal node) const {
  std::vector<int> names;
  for (const GridPoint& point : grid_points(node)) names.push_back(patch_sides_[point.patch]);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Corner c of the curve is corner c of the surface where the sweep starts, and c + the number of the curve's where it ends. With the body to the left
// of the curve's direction, that direction and the sweep's go round counterclockwise seen from outside.
ShellComplex sweep_surface(const CurveComplex& curve, const Spacing& layers, const Sweep& sweep, const SpatialPlacement& placement) {
  std::vector<ShellComplex::Patch> patches;
  for (int e = 0; e < static_cast<int>(curve.edges().size()); ++e) {
    const auto& edge = curve.edges()[e];
    const int above = curve.corner_count();
    patches.push_back({{edge.start, edge.end, edge.end + above, edge.start + above}, {edge.spacing.cells(), layers.cells()}, curve.side_of_edge(e)});
  }
  const auto position = [=](const ShellComplex::GridPoint& point) {
    return swept(sweep, curve.on_edge(point.patch, point.at[0]), layers.position(point.at[1]));
  };
  return ShellComplex(std::move(patches), position, placement);
}

}  // namespace mortise
