#include "mortise/mesh/swept_complex.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace mortise {

namespace {

/// Shape of the plane cells whose nodes lie half way up cells of a shape; none: no nodes lie there.
std::optional<CellShape> middle_profile_shape(CellShape shape) {
  return visit_cell(shape, [](auto cell) -> std::optional<CellShape> {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension == 3)
      if constexpr (!std::is_void_v<typename Cell::MiddleProfile>) return shape_of<typename Cell::MiddleProfile>;
    return std::nullopt;
  });
}

}  // namespace

std::optional<CellShape> SweptComplex::profile_shape(CellShape shape) {
  return visit_cell(shape, [](auto cell) -> std::optional<CellShape> {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension == 3)
      if constexpr (!std::is_void_v<typename Cell::Profile>) return shape_of<typename Cell::Profile>;
    return std::nullopt;
  });
}

SpatialPoint swept(const Sweep& sweep, const Point& point, double share) {
  const auto [x, y] = point;
  if (const auto* extrusion = std::get_if<Extrusion>(&sweep)) return {x, y, share * extrusion->length};
  const double angle = share * std::get<Revolution>(sweep).angle;
  return {x * std::cos(angle), y, x * std::sin(angle)};
}

SweptComplex::SweptComplex(CellShape shape, PatchComplex profile, Spacing layers, Sweep sweep, const std::array<std::string, 2>& ends,
                           SpatialPlacement placement)
    : shape_(shape),
      profile_(std::move(profile)),
      layers_(std::move(layers)),
      sweep_(sweep),
      placement_(placement),
      side_names_(profile_.side_names()) {
  if (profile_.shape() != profile_shape(shape)) throw std::logic_error("the profile's elements do not fit below the cells of the swept body");
  if (const auto middle = middle_profile_shape(shape)) middle_ = profile_.with_shape(*middle);
  side_names_.insert(side_names_.end(), ends.begin(), ends.end());
}

SpatialPoint SweptComplex::coordinate(GlobalOrdinal node) const {
  const auto [below, level] = find(node);
  return placement_(swept(sweep_, at_level(level).coordinate(below), layers_.doubled_position(level)));
}

double SweptComplex::radius(GlobalOrdinal node) const {
  const auto [below, level] = find(node);
  return at_level(level).coordinate(below)[0];
}

GlobalOrdinal SweptComplex::on_level(GlobalOrdinal node, int level) const {
  const Node place = find(node);
  return node_at({place.below, level + place.level % 2});
}

GlobalOrdinal SweptComplex::node_at(const Node& node) const {
  return node.level / 2 * nodes_per_cell_layer() + (node.level % 2 == 0 ? 0 : profile_.node_count()) + node.below;
}

SweptComplex::Node SweptComplex::find(GlobalOrdinal node) const {
  const auto layer = static_cast<int>(node / nodes_per_cell_layer());
  const GlobalOrdinal inside = node % nodes_per_cell_layer();
  return inside < profile_.node_count() ? Node{inside, 2 * layer} : Node{inside - profile_.node_count(), 2 * layer + 1};
}

SweptComplex::Cell SweptComplex::cell_of(GlobalOrdinal element) const {
  const GlobalOrdinal cell = element / elements_per_cell(), per_layer = profile_.element_count();
  return {cell % per_layer, static_cast<int>(cell / per_layer), static_cast<int>(element % elements_per_cell())};
}

/// A prism over the triangle with the profile's nodes a < b < c is cut into {a, b, c, c'}, {a, b, b', c'} and {a, a', b', c'}. Here ' marks the upper
/// layer. The diagonals that this draws on the prism's sides depend on the order of two nodes alone, so that neighbours draw the same.
SweptComplex::Corners SweptComplex::corners_of(const Cell& cell) const {
  const int lower = 2 * cell.layer, upper = lower + 2;
  Corners corners;
  if (!is_cut()) {
    for (const int level : {lower, upper})
      for (int a = 0; a < topology(profile_.shape()).corners; ++a) corners.push_back({a, level});
    return corners;
  }
  const auto nodes = profile_.element_nodes(cell.below);
  std::array<int, 3> ascending{0, 1, 2};
  std::sort(ascending.begin(), ascending.end(), [&](int a, int b) { return nodes[a] < nodes[b]; });
  const int last_below = 2 - cell.part;
  for (int a = 0; a <= last_below; ++a) corners.push_back({ascending[a], lower});
  for (int a = last_below; a < 3; ++a) corners.push_back({ascending[a], upper});
  // Two of the three are positively oriented if the numbers ascend counterclockwise, the middle one if they do not.
  const bool is_counterclockwise = (ascending[1] - ascending[0] + 3) % 3 == 1;
  if (is_counterclockwise == (cell.part == 1)) std::swap(corners[0], corners[1]);
  return corners;
}

CellNodes SweptComplex::element_nodes(GlobalOrdinal element) const {
  const Cell cell = cell_of(element);
  const Corners corners = corners_of(cell);
  const auto below = profile_.element_nodes(cell.below);
  CellNodes nodes;
  for (const Corner& corner : corners) nodes.push_back(node_at({below[corner.below], corner.level}));
  if (!middle_) return nodes;
  const auto of_middle = middle_->element_nodes(cell.below);
  const CellTopology &cell_below = topology(profile_.shape()), &own = topology(shape_);
  const auto& edges_below = cell_below.edges;
  for (int k = 0; k < own.mid_side_nodes(); ++k) {
    const auto [a, b] = own.edges[k];
    const int level = (corners[a].level + corners[b].level) / 2, p = corners[a].below, q = corners[b].below;
    const CellNodes& there = level % 2 == 0 ? below : of_middle;
    if (p == q) {
      nodes.push_back(node_at({there[p], level}));
      continue;
    }
    const auto edge = std::find_if(edges_below.begin(), edges_below.end(),
                                   [&, p = p, q = q](const auto& ends) { return (ends[0] == p && ends[1] == q) || (ends[0] == q && ends[1] == p); });
    nodes.push_back(node_at({there[cell_below.corners + (edge - edges_below.begin())], level}));
  }
  return nodes;
}

std::vector<GlobalOrdinal> SweptComplex::elements_of_node(GlobalOrdinal node) const {
  const auto [below, level] = find(node);
  std::vector<GlobalOrdinal> elements;
  const auto cells = at_level(level).elements_of_node(below);
  for (int layer = std::max(0, (level - 1) / 2); layer <= std::min(level / 2, layers_.cells() - 1); ++layer)
    for (const GlobalOrdinal cell : cells)
      for (int part = 0; part < elements_per_cell(); ++part) {
        const GlobalOrdinal element = (layer * profile_.element_count() + cell) * elements_per_cell() + part;
        if (is_cut()) {
          const auto nodes = element_nodes(element);
          if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
        }
        elements.push_back(element);
      }
  return elements;
}

std::vector<SurfaceSide> SweptComplex::surface_sides(GlobalOrdinal element) const {
  const Cell cell = cell_of(element);
  const auto sides_below = profile_.surface_sides(cell.below);
  const bool is_first = cell.layer == 0, is_last = cell.layer + 1 == layers_.cells();
  if (sides_below.empty() && !is_first && !is_last) return {};
  const auto corners = corners_of(cell);
  const auto& lines = topology(profile_.shape()).sides;
  const auto& own = topology(shape_);
  const int start = static_cast<int>(side_names_.size()) - 2, end = start + 1;
  std::vector<SurfaceSide> sides;
  for (int s = 0; s < static_cast<int>(own.sides.size()); ++s) {
    const auto first = own.sides[s].nodes.begin(), last = first + own.sides[s].corners;
    const auto all = [&](const auto& holds) { return std::all_of(first, last, [&](int a) { return holds(corners[a]); }); };
    if (is_first && all([&](const Corner& corner) { return corner.level == 2 * cell.layer; })) sides.push_back({s, start});
    if (is_last && all([&](const Corner& corner) { return corner.level == 2 * cell.layer + 2; })) sides.push_back({s, end});
    for (const SurfaceSide& side : sides_below) {
      const auto& line = lines[side.side].nodes;
      if (all([&](const Corner& corner) { return corner.below == line[0] || corner.below == line[1]; })) sides.push_back({s, side.name});
    }
  }
  return sides;
}

std::vector<int> SweptComplex::sides_of_node(GlobalOrdinal node) const {
  const auto [below, level] = find(node);
  auto names = at_level(level).sides_of_node(below);
  const int start = static_cast<int>(side_names_.size()) - 2;
  if (level == 0) names.push_back(start);
  if (level == 2 * layers_.cells()) names.push_back(start + 1);
  return names;
}

}  // namespace mortise
