#include "generators/collapsed_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "mortise/shape/hexahedron20.hpp"
#include "readers/file_cells.hpp"

namespace mortise {
namespace {

/// A cell of fewer corners: its shape, and which of the former corners are its own, in its order.
struct Collapsed {
  CellShape shape;
  std::vector<int> corners;
};

double volume(const SweptComplex& complex, const CellNodes& nodes, const std::array<int, 4>& corners) {
  std::array<SpatialPoint, 4> x;
  for (int c = 0; c < 4; ++c) x[c] = complex.coordinate(nodes[static_cast<std::size_t>(corners[c])]);
  std::array<SpatialPoint, 3> e;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = x[k + 1][i] - x[0][i];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) + e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Triangles (first, second, third) at the bottom and at the top; the middle one and the last are exchanged if that would turn it inside out.
Collapsed wedge(const SweptComplex& complex, const CellNodes& nodes, CellShape shape, std::array<int, 6> corners) {
  if (volume(complex, nodes, {corners[0], corners[1], corners[2], corners[3]}) < 0.0) {
    std::swap(corners[1], corners[2]);
    std::swap(corners[4], corners[5]);
  }
  return {shape, {corners.begin(), corners.end()}};
}

/// Rest of a cell whose corner c is the one of corner c + n, n half of them, where on_axis[c]. None: nothing is left.
std::optional<Collapsed> collapse(const SweptComplex& complex, const CellNodes& nodes, const std::vector<char>& on_axis, const Place& place) {
  const CellShape shape = complex.shape();
  const int below = topology(shape).corners / 2;  // corners of the profile's element
  const bool is_quadratic = topology(shape).nodes > topology(shape).corners;
  const auto refuse = [&](const char* what) {
    throw InputError(
        place,
        fmt::format("a cell of the profile at ({:.6g}, {:.6g}) meets the axis {}; please let edges of the profile's cells lie on the axis, or take "
                    "another element",
                    complex.coordinate(nodes[0])[0], complex.coordinate(nodes[0])[1], what));
  };
  const auto count = std::count(on_axis.begin(), on_axis.end(), 1);
  const int first = static_cast<int>(std::find(on_axis.begin(), on_axis.end(), 1) - on_axis.begin());
  if (below == 4) {
    if (count != 2) refuse("with one node or a whole side");
    const int a = on_axis[0] && on_axis[3] ? 3 : first, b = (a + 1) % 4, c = (a + 2) % 4, d = (a + 3) % 4;
    if (!on_axis[static_cast<std::size_t>(b)]) refuse("with two nodes that no edge joins");
    return wedge(complex, nodes, is_quadratic ? CellShape::wedge15 : CellShape::wedge6, {a, d, d + 4, b, c, c + 4});
  }
  if (count == 3) refuse("with all of its nodes");
  if (count == 2) {
    const int off = static_cast<int>(std::find(on_axis.begin(), on_axis.end(), 0) - on_axis.begin());
    std::array<int, 4> corners{(off + 1) % 3, (off + 2) % 3, off, off + 3};
    if (volume(complex, nodes, corners) < 0.0) std::swap(corners[0], corners[1]);
    return Collapsed{is_quadratic ? CellShape::tetrahedron10 : CellShape::tetrahedron4, {corners.begin(), corners.end()}};
  }
  if (is_quadratic) refuse("with one node, where pyramids of 13 nodes would be");
  std::array<int, 5> corners{(first + 1) % 3, (first + 2) % 3, (first + 2) % 3 + 3, (first + 1) % 3 + 3, first};
  if (volume(complex, nodes, {corners[0], corners[1], corners[3], corners[4]}) < 0.0) std::swap(corners[1], corners[3]);
  return Collapsed{CellShape::pyramid5, {corners.begin(), corners.end()}};
}

class Collapse {
 public:
  Collapse(const SweptComplex& complex, const Place& place) : complex_(complex), place_(place) {
    if (complex.node_count() > std::numeric_limits<std::int32_t>::max() || complex.element_count() > std::numeric_limits<std::int32_t>::max())
      throw InputError(place, fmt::format("a revolved mesh that reaches the axis has {} nodes; allowed: 2^31 - 1", complex.node_count()));
    double most = 0.0;
    for (GlobalOrdinal node = 0; node < complex.profile().node_count(); ++node) most = std::max(most, complex.profile().coordinate(node)[0]);
    near_ = 1e-9 * most;
  }

  MeshFile make() {
    file_.path = "the revolved mesh";
    for (GlobalOrdinal node = 0; node < complex_.node_count(); ++node) {
      file_.coordinates.push_back(complex_.coordinate(node));
      file_.node_labels.push_back(node);
    }
    for (const std::string& name : complex_.side_names()) file_.side_sets.push_back({name, {}});
    find_middles();
    for (GlobalOrdinal element = 0; element < complex_.element_count(); ++element) add(element);
    add_inherited_sides();
    const auto is_empty = [](const FileSet<FileSide>& set) { return set.members.empty(); };  // a side that lies on the axis
    file_.side_sets.erase(std::remove_if(file_.side_sets.begin(), file_.side_sets.end(), is_empty), file_.side_sets.end());
    return std::move(file_);
  }

 private:
  bool is_on_axis(GlobalOrdinal node) const { return complex_.radius(node) <= near_; }
  /// Nodes of the axis are those of the first layer.
  GlobalOrdinal merged(GlobalOrdinal node) const { return is_on_axis(node) ? complex_.on_level(node, 0) : node; }

  static std::array<GlobalOrdinal, 2> edge(GlobalOrdinal a, GlobalOrdinal b) { return {std::min(a, b), std::max(a, b)}; }

  /// Of the nodes that are in the middle of an edge between merged corners the one that lies in a plane of nodes: others belong to edges that were
  /// diagonals.
  void find_middles() {
    const CellTopology& cell = topology(complex_.shape());
    for (GlobalOrdinal element = 0; element < complex_.element_count() && cell.mid_side_nodes() > 0; ++element) {
      const CellNodes nodes = complex_.element_nodes(element);
      for (int k = 0; k < cell.mid_side_nodes(); ++k) {
        const auto [a, b] = cell.edges[static_cast<std::size_t>(k)];
        const GlobalOrdinal first = merged(nodes[static_cast<std::size_t>(a)]), second = merged(nodes[static_cast<std::size_t>(b)]);
        if (first == second) continue;
        const GlobalOrdinal middle = merged(nodes[static_cast<std::size_t>(cell.corners + k)]);
        const auto [found, is_new] = middles_.try_emplace(edge(first, second), middle);
        if (!is_new && complex_.level_of(middle) % 2 == 0) found->second = middle;
      }
    }
  }

  void add(GlobalOrdinal element) {
    const CellTopology& cell = topology(complex_.shape());
    const CellNodes nodes = complex_.element_nodes(element);
    std::vector<GlobalOrdinal> corners;
    for (int c = 0; c < cell.corners; ++c) corners.push_back(merged(nodes[static_cast<std::size_t>(c)]));
    Collapsed left{complex_.shape(), {}};
    for (int c = 0; c < cell.corners; ++c) left.corners.push_back(c);
    if (cell.corners == 4) {  // a tetrahedron of a cut prism
      auto sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        for (const SurfaceSide& side : complex_.surface_sides(element)) keep_for_neighbour(side, corners);
        return;
      }
    } else {
      std::vector<char> on_axis;
      for (int c = 0; c < cell.corners / 2; ++c) on_axis.push_back(is_on_axis(nodes[static_cast<std::size_t>(c)]) ? 1 : 0);
      if (std::count(on_axis.begin(), on_axis.end(), 1) > 0) left = *collapse(complex_, nodes, on_axis, place_);
    }
    const auto group = group_of(left.shape);
    FileCells& cells = file_.cells[group];
    std::vector<GlobalOrdinal> own;
    for (const int c : left.corners) own.push_back(corners[static_cast<std::size_t>(c)]);
    const CellTopology& shape = topology(left.shape);
    for (int k = 0; k < shape.mid_side_nodes(); ++k) {
      const auto [a, b] = shape.edges[static_cast<std::size_t>(k)];
      own.push_back(middles_.at(edge(own[static_cast<std::size_t>(a)], own[static_cast<std::size_t>(b)])));
    }
    for (const GlobalOrdinal node : own) cells.nodes.push_back(static_cast<std::int32_t>(node));
    cells.labels.push_back(element);
    for (const SurfaceSide& side : complex_.surface_sides(element)) add_side(side, corners, own, shape, group, cells.labels.size() - 1);
  }

  std::size_t group_of(CellShape shape) {
    for (std::size_t group = 0; group < file_.cells.size(); ++group)
      if (file_.cells[group].shape == shape) return group;
    file_.cells.push_back({shape, {}, {}});
    return file_.cells.size() - 1;
  }

  /// The corners of a side, each once, ascending.
  std::vector<GlobalOrdinal> corners_left(const SurfaceSide& side, const std::vector<GlobalOrdinal>& corners) const {
    const CellSide& former = topology(complex_.shape()).sides[static_cast<std::size_t>(side.side)];
    std::vector<GlobalOrdinal> left;
    for (int c = 0; c < former.corners; ++c) left.push_back(corners[static_cast<std::size_t>(former.nodes[static_cast<std::size_t>(c)])]);
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    return left;
  }

  static std::vector<GlobalOrdinal> corners_of(const CellTopology& shape, std::size_t side, const std::vector<GlobalOrdinal>& own) {
    std::vector<GlobalOrdinal> corners;
    for (int c = 0; c < shape.sides[side].corners; ++c)
      corners.push_back(own[static_cast<std::size_t>(shape.sides[side].nodes[static_cast<std::size_t>(c)])]);
    std::sort(corners.begin(), corners.end());
    return corners;
  }

  void add_member(int name, std::size_t group, std::size_t cell, std::size_t side) {
    file_.side_sets[static_cast<std::size_t>(name)].members.push_back(
        {static_cast<std::int32_t>(group), static_cast<std::int32_t>(cell), static_cast<std::int32_t>(side)});
  }

  /// A side that has lost its area is none.
  void add_side(const SurfaceSide& side, const std::vector<GlobalOrdinal>& corners, const std::vector<GlobalOrdinal>& own, const CellTopology& shape,
                std::size_t group, std::size_t cell) {
    const auto wanted = corners_left(side, corners);
    for (std::size_t s = 0; s < shape.sides.size(); ++s)
      if (corners_of(shape, s, own) == wanted) add_member(side.name, group, cell, s);
  }

  /// The side of a tetrahedron without volume that has an area is now the side of its neighbour.
  void keep_for_neighbour(const SurfaceSide& side, const std::vector<GlobalOrdinal>& corners) {
    if (const auto left = corners_left(side, corners); left.size() == 3) inherited_[left] = side.name;
  }

  void add_inherited_sides() {
    for (std::size_t group = 0; group < file_.cells.size() && !inherited_.empty(); ++group) {
      const CellTopology& shape = topology(file_.cells[group].shape);
      for (std::size_t cell = 0; cell < file_.cells[group].labels.size(); ++cell) {
        const auto first = file_.cells[group].nodes.begin() + static_cast<std::ptrdiff_t>(cell) * shape.nodes;
        const std::vector<GlobalOrdinal> own(first, first + shape.corners);
        for (std::size_t s = 0; s < shape.sides.size(); ++s)
          if (const auto found = inherited_.find(corners_of(shape, s, own)); found != inherited_.end()) add_member(found->second, group, cell, s);
      }
    }
  }

  const SweptComplex& complex_;
  const Place& place_;
  double near_ = 0.0;
  MeshFile file_;
  std::map<std::array<GlobalOrdinal, 2>, GlobalOrdinal> middles_;
  std::map<std::vector<GlobalOrdinal>, int> inherited_;  ///< names of sides by their corners
};

}  // namespace

MeshFile collapse_onto_axis(const SweptComplex& complex, const Place& place) { return Collapse(complex, place).make(); }

// Nodes of the axis with one height are the first of them.
MeshFile collapse_onto_axis(const ShellComplex& unplaced, const ShellComplex& placed, double near) {
  MeshFile file;
  file.path = "the revolved surface";
  std::vector<GlobalOrdinal> merged;
  std::map<double, GlobalOrdinal> on_axis;
  for (GlobalOrdinal node = 0; node < placed.node_count(); ++node) {
    const SpatialPoint x = unplaced.coordinate(node);
    merged.push_back(std::hypot(x[0], x[2]) > near ? node : on_axis.try_emplace(x[1], node).first->second);
    file.coordinates.push_back(placed.coordinate(node));
    file.node_labels.push_back(node);
  }
  file.cells = {{CellShape::triangle3, {}, {}}, {CellShape::quadrilateral4, {}, {}}};
  for (const std::string& name : placed.side_names()) file.cell_sets.push_back({name, {}});
  for (GlobalOrdinal element = 0; element < placed.element_count(); ++element) {
    const CellNodes nodes = placed.element_nodes(element);
    std::vector<std::int32_t> own;
    for (const GlobalOrdinal node : nodes)
      if (const auto one = static_cast<std::int32_t>(merged[static_cast<std::size_t>(node)]); std::find(own.begin(), own.end(), one) == own.end())
        own.push_back(one);
    if (own.size() < 3) continue;  // a line on the axis
    const auto group = static_cast<std::int32_t>(own.size()) - 3;
    FileCells& cells = file.cells[static_cast<std::size_t>(group)];
    auto& members = file.cell_sets[static_cast<std::size_t>(placed.surface_sides(element).front().name)].members;
    members.push_back({group, static_cast<std::int32_t>(cells.labels.size()), 1});
    cells.nodes.insert(cells.nodes.end(), own.begin(), own.end());
    cells.labels.push_back(element);
  }
  for (auto& set : file.cell_sets) join_ranges(set.members);
  const auto is_empty = [](const auto& set) { return set.members.empty(); };  // a side that lies on the axis
  file.cell_sets.erase(std::remove_if(file.cell_sets.begin(), file.cell_sets.end(), is_empty), file.cell_sets.end());
  if (file.cells.back().labels.empty()) file.cells.pop_back();
  return file;
}

}  // namespace mortise
