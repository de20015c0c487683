#include "mortise/mesh/swept_complex.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mortise {

CellShape SweptComplex::profile_shape(CellShape shape) {
  if (shape == CellShape::hexahedron8) return CellShape::quadrilateral4;
  if (shape == CellShape::tetrahedron4) return CellShape::triangle3;
  throw std::logic_error("a swept body is made of hexahedra or tetrahedra");
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
  side_names_.insert(side_names_.end(), ends.begin(), ends.end());
}

SpatialPoint SweptComplex::coordinate(GlobalOrdinal node) const {
  const auto [x, y] = profile_.coordinate(node % profile_.node_count());
  const double s = layers_.position(static_cast<int>(node / profile_.node_count()));
  if (const auto* extrusion = std::get_if<Extrusion>(&sweep_)) return placement_({x, y, s * extrusion->length});
  const double angle = s * std::get<Revolution>(sweep_).angle;
  return placement_({x * std::cos(angle), y, x * std::sin(angle)});
}

SweptComplex::Cell SweptComplex::cell_of(GlobalOrdinal element) const {
  const GlobalOrdinal cell = element / elements_per_cell(), per_layer = profile_.element_count();
  return {cell % per_layer, static_cast<int>(cell / per_layer), static_cast<int>(element % elements_per_cell())};
}

/// A prism over the triangle with the profile's nodes a < b < c is cut into {a, b, c, c'}, {a, b, b', c'} and {a, a', b', c'}, where ' marks the
/// upper layer. The diagonals that this draws on the prism's sides depend on the order of two nodes alone, so that neighbours draw the same.
SweptComplex::Corners SweptComplex::corners_of(const Cell& cell) const {
  auto below = profile_.element_nodes(cell.below);
  Corners corners;
  if (shape_ == CellShape::hexahedron8) {
    for (const int layer : {cell.layer, cell.layer + 1})
      for (const GlobalOrdinal node : below) corners.push_back({node, layer});
    return corners;
  }
  // Two of the three are positively oriented if the numbers ascend counterclockwise, the middle one if they do not.
  const bool ascends =
      (below[0] < below[1] && below[1] < below[2]) || (below[1] < below[2] && below[2] < below[0]) || (below[2] < below[0] && below[0] < below[1]);
  std::sort(below.begin(), below.end());
  const int last_below = 2 - cell.part;
  for (int a = 0; a <= last_below; ++a) corners.push_back({below[a], cell.layer});
  for (int a = last_below; a < 3; ++a) corners.push_back({below[a], cell.layer + 1});
  if (ascends == (cell.part == 1)) std::swap(corners[0], corners[1]);
  return corners;
}

CellNodes SweptComplex::element_nodes(GlobalOrdinal element) const {
  CellNodes nodes;
  for (const Corner& corner : corners_of(cell_of(element))) nodes.push_back(corner.layer * profile_.node_count() + corner.below);
  return nodes;
}

std::vector<GlobalOrdinal> SweptComplex::elements_of_node(GlobalOrdinal node) const {
  const int layer = static_cast<int>(node / profile_.node_count());
  const auto below = profile_.elements_of_node(node % profile_.node_count());
  std::vector<GlobalOrdinal> elements;
  for (int l = std::max(0, layer - 1); l <= std::min(layer, layers_.cells() - 1); ++l)
    for (const GlobalOrdinal cell : below)
      for (int part = 0; part < elements_per_cell(); ++part) {
        const GlobalOrdinal element = (l * profile_.element_count() + cell) * elements_per_cell() + part;
        if (elements_per_cell() > 1) {
          const auto nodes = element_nodes(element);
          if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
        }
        elements.push_back(element);
      }
  return elements;
}

std::vector<SurfaceSide> SweptComplex::surface_sides(GlobalOrdinal element) const {
  const Cell cell = cell_of(element);
  const auto below_sides = profile_.surface_sides(cell.below);
  const bool is_first = cell.layer == 0, is_last = cell.layer + 1 == layers_.cells();
  if (below_sides.empty() && !is_first && !is_last) return {};
  const auto corners = corners_of(cell);
  const auto below = profile_.element_nodes(cell.below);
  const auto& below_topology = topology(profile_.shape());
  const auto& own = topology(shape_);
  const int start = static_cast<int>(side_names_.size()) - 2, end = start + 1;
  std::vector<SurfaceSide> sides;
  for (int s = 0; s < static_cast<int>(own.sides.size()); ++s) {
    const auto& side = own.sides[s];
    const auto all = [&](const auto& holds) { return std::all_of(side.begin(), side.end(), [&](int a) { return holds(corners[a]); }); };
    if (is_first && all([&](const Corner& corner) { return corner.layer == cell.layer; })) sides.push_back({s, start});
    if (is_last && all([&](const Corner& corner) { return corner.layer == cell.layer + 1; })) sides.push_back({s, end});
    for (const SurfaceSide& line : below_sides) {
      const auto& ends = below_topology.sides[line.side];
      if (all([&](const Corner& corner) { return corner.below == below[ends[0]] || corner.below == below[ends[1]]; }))
        sides.push_back({s, line.name});
    }
  }
  return sides;
}

std::vector<int> SweptComplex::sides_of_node(GlobalOrdinal node) const {
  const int layer = static_cast<int>(node / profile_.node_count()), start = static_cast<int>(side_names_.size()) - 2;
  auto names = profile_.sides_of_node(node % profile_.node_count());
  if (layer == 0) names.push_back(start);
  if (layer == layers_.cells()) names.push_back(start + 1);
  return names;
}

}  // namespace mortise
