#include "mortise/mesh/patch_complex.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <map>
#include <stdexcept>

#include "generators/interval.hpp"
#include "mortise/mesh/curve_complex.hpp"

namespace mortise {
namespace {

using boost::math::constants::pi;

/// Corners between which the four sides of a patch run in the direction of growing i or j.
constexpr std::array<std::array<int, 2>, 4> side_corners{{{0, 1}, {1, 2}, {3, 2}, {0, 3}}};

Point along(const Point& a, const Point& b, double s) { return {(1.0 - s) * a[0] + s * b[0], (1.0 - s) * a[1] + s * b[1]}; }

}  // namespace

Point Placement::operator()(const Point& point) const {
  if (rotation == 0.0) return {point[0] + translation[0], point[1] + translation[1]};
  const double angle = rotation * pi<double>() / 180.0, c = std::cos(angle), s = std::sin(angle);
  return {c * point[0] - s * point[1] + translation[0], s * point[0] + c * point[1] + translation[1]};
}

PatchComplex::PatchComplex(CellShape shape, std::vector<Point> corners, std::vector<Edge> edges, std::vector<Patch> patches, Placement placement)
    : shape_(shape),
      corners_(std::move(corners)),
      edges_(std::move(edges)),
      patches_(std::move(patches)),
      placement_(placement),
      corner_patches_(corners_.size()),
      edge_patches_(edges_.size()) {
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const auto& patch = patches_[p];
    std::array<EdgeUse, 4> uses{};
    std::array<int, 4> names{};
    for (int slot = 0; slot < 4; ++slot) {
      const int a = patch.corners[side_corners[slot][0]], b = patch.corners[side_corners[slot][1]];
      const auto edge =
          std::find_if(edges_.begin(), edges_.end(), [&](const Edge& e) { return (e.start == a && e.end == b) || (e.start == b && e.end == a); });
      if (edge == edges_.end()) throw std::logic_error("a patch needs an edge between corners " + std::to_string(a) + " and " + std::to_string(b));
      uses[slot] = {static_cast<int>(edge - edges_.begin()), edge->start != a};
      edge_patches_[uses[slot].edge].push_back({static_cast<int>(p), slot});
      corner_patches_[patch.corners[slot]].push_back({static_cast<int>(p), slot});
      names[slot] = -1;
      if (patch.sides[slot].empty()) continue;
      const auto name = std::find(side_names_.begin(), side_names_.end(), patch.sides[slot]);
      names[slot] = static_cast<int>(name - side_names_.begin());
      if (name == side_names_.end()) side_names_.push_back(patch.sides[slot]);
    }
    for (int slot = 0; slot < 2; ++slot)
      if (edges_[uses[slot].edge].spacing.cells() != edges_[uses[slot + 2].edge].spacing.cells())
        throw std::logic_error("opposite edges of patch " + std::to_string(p) + " have different numbers of cells");
    uses_.push_back(uses);
    patch_sides_.push_back(names);
  }
  edge_nodes_.push_back(static_cast<GlobalOrdinal>(corners_.size()));
  for (const Edge& edge : edges_) {
    edge_lattices_.emplace_back(shape_, 1, std::array<int, 3>{edge.spacing.cells()});
    edge_nodes_.push_back(edge_nodes_.back() + edge_lattices_.back().size());
  }
  patch_nodes_.push_back(edge_nodes_.back());
  patch_cells_.push_back(0);
  for (int p = 0; p < static_cast<int>(patches_.size()); ++p) {
    patch_lattices_.emplace_back(shape_, 2, std::array<int, 3>{cells_i(p), cells_j(p)});
    patch_nodes_.push_back(patch_nodes_.back() + patch_lattices_.back().size());
    patch_cells_.push_back(patch_cells_.back() + static_cast<GlobalOrdinal>(cells_i(p)) * cells_j(p));
  }
}

Point edge_point(const PatchComplex::Edge& edge, const std::vector<Point>& corners, int index) {
  const Point &a = corners[edge.start], &b = corners[edge.end];
  if (index == 0) return a;
  if (index == 2 * edge.spacing.cells()) return b;
  const double s = edge.spacing.doubled_position(index);
  if (!edge.center) return along(a, b, s);
  const Point& c = *edge.center;
  const double radius = std::hypot(a[0] - c[0], a[1] - c[1]), first = std::atan2(a[1] - c[1], a[0] - c[0]);
  const double turn = edge.sweep ? *edge.sweep : std::remainder(std::atan2(b[1] - c[1], b[0] - c[0]) - first, 2.0 * pi<double>());
  const double angle = first + s * turn;
  return {c[0] + radius * std::cos(angle), c[1] + radius * std::sin(angle)};
}

double PatchComplex::edge_position(const EdgeUse& use, int index) const {
  const auto& spacing = edges_[use.edge].spacing;
  return use.flipped ? 1.0 - spacing.doubled_position(2 * spacing.cells() - index) : spacing.doubled_position(index);
}

Point PatchComplex::edge_point(const EdgeUse& use, int index) const {
  return mortise::edge_point(edges_[use.edge], corners_, use.flipped ? 2 * edges_[use.edge].spacing.cells() - index : index);
}

Point PatchComplex::coordinate(GlobalOrdinal node) const {
  if (node < edge_nodes_.front()) return placement_(corners_[node]);
  if (node < patch_nodes_.front()) {
    const int e = interval(edge_nodes_, node);
    return placement_(mortise::edge_point(edges_[e], corners_, edge_lattices_[e].point(node - edge_nodes_[e])[0]));
  }
  const auto [p, i, j] = grid_points(node).front();
  const auto& [bottom, right, top, left] = uses_[p];
  // Parameters (u, v) where the straight lines between opposite edge positions cross:
  // u = (1 - v) s_bottom + v s_top,  v = (1 - u) s_left + u s_right.
  const double b = edge_position(bottom, i), t = edge_position(top, i), l = edge_position(left, j), r = edge_position(right, j);
  const double u = (b + l * (t - b)) / (1.0 - (t - b) * (r - l));
  const double v = l + u * (r - l);
  // x = (1-v) x_bottom + v x_top + (1-u) x_left + u x_right - bilinear interpolation of the corners (Gordon and Hall).
  const Point bottom_top = along(edge_point(bottom, i), edge_point(top, i), v), left_right = along(edge_point(left, j), edge_point(right, j), u);
  const auto& c = patches_[p].corners;
  const Point bilinear = along(along(corners_[c[0]], corners_[c[1]], u), along(corners_[c[3]], corners_[c[2]], u), v);
  return placement_({bottom_top[0] + left_right[0] - bilinear[0], bottom_top[1] + left_right[1] - bilinear[1]});
}

CurveComplex PatchComplex::surface() const {
  std::vector<Point> corners;
  std::vector<Edge> edges;
  std::vector<std::string> names;
  std::map<int, int> corner_of;  // of the patches -> of the curve
  const auto corner = [&](int of_patches) {
    const auto [found, is_new] = corner_of.try_emplace(of_patches, static_cast<int>(corners.size()));
    if (is_new) corners.push_back(corners_[of_patches]);
    return found->second;
  };
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (int slot = 0; slot < 4; ++slot) {
      if (patch_sides_[p][slot] < 0) continue;
      const EdgeUse& use = uses_[p][slot];
      Edge edge = edges_[use.edge];
      // Round the patch counterclockwise: sides 0 and 1 run with their grid direction, 2 and 3 against it.
      if (use.flipped != (slot >= 2)) {
        std::swap(edge.start, edge.end);
        edge.spacing = edge.spacing.reversed();
        if (edge.sweep) edge.sweep = -*edge.sweep;
      }
      edge.start = corner(edge.start);
      edge.end = corner(edge.end);
      edges.push_back(edge);
      names.push_back(side_names_[patch_sides_[p][slot]]);
    }
  return CurveComplex(std::move(corners), std::move(edges), std::move(names), placement_);
}

PatchComplex::GridPoint PatchComplex::cell_of(GlobalOrdinal element) const {
  const GlobalOrdinal cell = element / elements_per_cell();
  const int p = interval(patch_cells_, cell);
  const GlobalOrdinal inside = cell - patch_cells_[p];
  return {p, 2 * static_cast<int>(inside % cells_i(p)), 2 * static_cast<int>(inside / cells_i(p))};
}

GlobalOrdinal PatchComplex::node_at(const GridPoint& point) const {
  const int p = point.patch, i = point.i, j = point.j;
  const int ni = 2 * cells_i(p), nj = 2 * cells_j(p);
  const auto& corners = patches_[p].corners;
  if (j == 0 && (i == 0 || i == ni)) return corners[i == 0 ? 0 : 1];
  if (j == nj && (i == 0 || i == ni)) return corners[i == 0 ? 3 : 2];
  const auto on_edge = [&](int slot, int index) {
    const auto& use = uses_[p][slot];
    return edge_nodes_[use.edge] + edge_lattices_[use.edge].index({use.flipped ? 2 * edges_[use.edge].spacing.cells() - index : index});
  };
  if (j == 0) return on_edge(0, i);
  if (i == ni) return on_edge(1, j);
  if (j == nj) return on_edge(2, i);
  if (i == 0) return on_edge(3, j);
  return patch_nodes_[p] + patch_lattices_[p].index({i, j});
}

std::vector<PatchComplex::GridPoint> PatchComplex::grid_points(GlobalOrdinal node) const {
  std::vector<GridPoint> points;
  if (node < edge_nodes_.front()) {
    for (const auto& use : corner_patches_[node])
      points.push_back({use.patch, use.slot == 1 || use.slot == 2 ? 2 * cells_i(use.patch) : 0, use.slot >= 2 ? 2 * cells_j(use.patch) : 0});
  } else if (node < patch_nodes_.front()) {
    const int e = interval(edge_nodes_, node), end = 2 * edges_[e].spacing.cells();
    const int index = edge_lattices_[e].point(node - edge_nodes_[e])[0];
    for (const auto& [p, slot] : edge_patches_[e]) {
      const int k = uses_[p][slot].flipped ? end - index : index;
      if (slot == 0) points.push_back({p, k, 0});
      if (slot == 1) points.push_back({p, 2 * cells_i(p), k});
      if (slot == 2) points.push_back({p, k, 2 * cells_j(p)});
      if (slot == 3) points.push_back({p, 0, k});
    }
  } else {
    const int p = interval(patch_nodes_, node);
    const auto inside = patch_lattices_[p].point(node - patch_nodes_[p]);
    points.push_back({p, inside[0], inside[1]});
  }
  return points;
}

PatchComplex::GridPoints PatchComplex::corners_of(GlobalOrdinal element) const {
  const auto [p, i, j] = cell_of(element);
  const std::array<GridPoint, 4> n{{{p, i, j}, {p, i + 2, j}, {p, i + 2, j + 2}, {p, i, j + 2}}};
  if (!is_cut()) return {n.begin(), n.end()};
  const bool first = element % 2 == 0;
  if ((i + j) % 4 == 0) return first ? GridPoints{n[0], n[1], n[2]} : GridPoints{n[0], n[2], n[3]};
  return first ? GridPoints{n[0], n[1], n[3]} : GridPoints{n[1], n[2], n[3]};
}

CellNodes PatchComplex::element_nodes(GlobalOrdinal element) const {
  const GridPoints corners = corners_of(element);
  CellNodes nodes;
  for (const GridPoint& corner : corners) nodes.push_back(node_at(corner));
  const CellTopology& cell = topology(shape_);
  for (int k = 0; k < cell.mid_side_nodes(); ++k) {
    const auto [a, b] = cell.edges[k];
    nodes.push_back(node_at({corners[a].patch, (corners[a].i + corners[b].i) / 2, (corners[a].j + corners[b].j) / 2}));
  }
  return nodes;
}

std::vector<GlobalOrdinal> PatchComplex::elements_of_node(GlobalOrdinal node) const {
  std::vector<GlobalOrdinal> elements;
  for (const auto& [p, i, j] : grid_points(node))
    for (int cj = std::max(0, (j - 1) / 2); cj <= std::min(j / 2, cells_j(p) - 1); ++cj)
      for (int ci = std::max(0, (i - 1) / 2); ci <= std::min(i / 2, cells_i(p) - 1); ++ci) {
        const GlobalOrdinal cell = patch_cells_[p] + static_cast<GlobalOrdinal>(cj) * cells_i(p) + ci;
        for (int k = 0; k < elements_per_cell(); ++k) {
          const GlobalOrdinal element = cell * elements_per_cell() + k;
          const auto nodes = element_nodes(element);
          if (std::find(nodes.begin(), nodes.end(), node) != nodes.end()) elements.push_back(element);
        }
      }
  std::sort(elements.begin(), elements.end());
  return elements;
}

std::vector<SurfaceSide> PatchComplex::surface_sides(GlobalOrdinal element) const {
  const auto [p, i, j] = cell_of(element);
  const std::array<bool, 4> at_edge{j == 0, i == 2 * cells_i(p) - 2, j == 2 * cells_j(p) - 2, i == 0};
  // The triangle (0 or 1) of a cut cell that has the cell's side, and its own side there: diagonal 0-2 in every second cell, else 1-3.
  constexpr std::array<std::array<int, 2>, 4> even{{{0, 0}, {0, 1}, {1, 1}, {1, 2}}}, odd{{{0, 0}, {1, 0}, {1, 1}, {0, 2}}};
  std::vector<SurfaceSide> sides;
  for (int slot = 0; slot < 4; ++slot) {
    if (!at_edge[slot] || patch_sides_[p][slot] < 0) continue;
    if (!is_cut()) {
      sides.push_back({slot, patch_sides_[p][slot]});
    } else {
      const auto& [triangle, side] = ((i + j) % 4 == 0 ? even : odd)[slot];
      if (triangle == element % 2) sides.push_back({side, patch_sides_[p][slot]});
    }
  }
  return sides;
}

std::vector<int> PatchComplex::sides_of_node(GlobalOrdinal node) const {
  std::vector<int> names;
  for (const auto& [p, i, j] : grid_points(node)) {
    const std::array<bool, 4> at_edge{j == 0, i == 2 * cells_i(p), j == 2 * cells_j(p), i == 0};
    for (int slot = 0; slot < 4; ++slot)
      if (at_edge[slot] && patch_sides_[p][slot] >= 0) names.push_back(patch_sides_[p][slot]);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace mortise
