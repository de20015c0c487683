#include "mortise/mesh/volume_complex.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "generators/interval.hpp"

namespace mortise {
namespace {

/// Start (0), inside (1) or end (2) in each direction.
std::array<int, 3> digits(int part) { return {part % 3, part / 3 % 3, part / 9}; }

}  // namespace

VolumeComplex::VolumeComplex(CellShape shape, std::vector<Block> blocks, Position position, SpatialPlacement placement)
    : shape_(shape), blocks_(std::move(blocks)), position_(std::move(position)), placement_(placement), parts_(blocks_.size()) {
  if (!is_made_of(shape)) throw std::logic_error("blocks are made of hexahedra or tetrahedra");
  for (int dimension = 0; dimension <= 3; ++dimension) add_entities(dimension);
  for (const Entity& entity : entities_) first_node_.push_back(first_node_.back() + entity.lattice.size());
  for (const Block& block : blocks_) {
    first_cell_.push_back(first_cell_.back() + static_cast<GlobalOrdinal>(block.cells[0]) * block.cells[1] * block.cells[2]);
    std::array<int, 6> names{};
    for (int side = 0; side < 6; ++side) {
      names[side] = -1;
      if (block.sides[side].empty()) continue;
      const auto name = std::find(side_names_.begin(), side_names_.end(), block.sides[side]);
      names[side] = static_cast<int>(name - side_names_.begin());
      if (name == side_names_.end()) side_names_.push_back(block.sides[side]);
    }
    block_sides_.push_back(names);
  }
}

bool VolumeComplex::is_made_of(CellShape shape) {
  const CellTopology& cell = topology(shape);
  return cell.dimension == 3 && (cell.corners == 8 || cell.corners == 4);
}

/// An entity is known by its corners; its directions are those of the first block that has it.
void VolumeComplex::add_entities(int dimension) {
  struct Known {
    int entity;
    std::vector<int> corners;
    std::array<int, 3> cells;
  };
  std::map<std::vector<int>, Known> known;
  for (int b = 0; b < static_cast<int>(blocks_.size()); ++b)
    for (int part = 0; part < parts_of_block; ++part) {
      const auto at = digits(part);
      std::array<int, 3> axes{};
      int count = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (at[axis] == 1) axes[count++] = axis;
      if (count != dimension) continue;
      // Corners and cells if the entity's directions are those of `axes`.
      const auto describe = [&](std::vector<int>& corners, std::array<int, 3>& cells) {
        corners.clear();
        for (int c = 0; c < (1 << dimension); ++c) {
          int corner = 0;
          for (int axis = 0; axis < 3; ++axis) corner += at[axis] == 2 ? 1 << axis : 0;
          for (int d = 0; d < dimension; ++d) corner += (c >> d & 1) << axes[d];
          corners.push_back(blocks_[b].corners[corner]);
        }
        cells = {};
        for (int d = 0; d < dimension; ++d) cells[d] = blocks_[b].cells[axes[d]];
      };
      std::vector<int> corners;
      std::array<int, 3> cells;
      describe(corners, cells);
      auto sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      const auto [found, is_new] = known.try_emplace(sorted, Known{static_cast<int>(entities_.size()), corners, cells});
      if (is_new) entities_.push_back({Lattice(shape_, dimension, cells), {}});
      if (!is_new && dimension == 2 && corners != found->second.corners) {
        std::swap(axes[0], axes[1]);
        describe(corners, cells);
      }
      if (corners != found->second.corners || cells != found->second.cells)
        throw std::logic_error("blocks that share an edge or a face have to run through it in the same direction with the same cells");
      parts_[b][part] = {found->second.entity, axes};
      entities_[found->second.entity].uses.push_back({b, part});
    }
}

GlobalOrdinal VolumeComplex::node_at(const GridPoint& point) const {
  int part = 0;
  for (int axis = 2; axis >= 0; --axis) part = 3 * part + (point.at[axis] == 0 ? 0 : point.at[axis] == 2 * blocks_[point.block].cells[axis] ? 2 : 1);
  const PartUse& use = parts_[point.block][part];
  return first_node_[use.entity] + entities_[use.entity].lattice.index({point.at[use.axes[0]], point.at[use.axes[1]], point.at[use.axes[2]]});
}

std::vector<VolumeComplex::GridPoint> VolumeComplex::grid_points(GlobalOrdinal node) const {
  const int e = interval(first_node_, node);
  const auto inside = entities_[e].lattice.point(node - first_node_[e]);
  std::vector<GridPoint> points;
  for (const auto& [block, part] : entities_[e].uses) {
    const auto at = digits(part);
    GridPoint point{block, {}};
    for (int axis = 0, d = 0; axis < 3; ++axis) {
      if (at[axis] == 1)
        point.at[parts_[block][part].axes[d]] = inside[d], ++d;
      else
        point.at[axis] = at[axis] * blocks_[block].cells[axis];
    }
    points.push_back(point);
  }
  return points;
}

SpatialPoint VolumeComplex::coordinate(GlobalOrdinal node) const { return placement_(position_(grid_points(node).front())); }

VolumeComplex::GridPoint VolumeComplex::cell_of(GlobalOrdinal element) const {
  const GlobalOrdinal cell = element / elements_per_cell();
  const int b = interval(first_cell_, cell);
  const auto& cells = blocks_[b].cells;
  const GlobalOrdinal inside = cell - first_cell_[b], row = inside / cells[0];
  return {b, {2 * static_cast<int>(inside % cells[0]), 2 * static_cast<int>(row % cells[1]), 2 * static_cast<int>(row / cells[1])}};
}

/// Tetrahedra by Kuhn: from the cell's start to its end along its edges, one direction after the other, in each of the six orders of the directions.
VolumeComplex::GridPoints VolumeComplex::corners_of(GlobalOrdinal element) const {
  const GridPoint start = cell_of(element);
  const auto moved = [](GridPoint point, int i, int j, int k) {
    point.at[0] += 2 * i, point.at[1] += 2 * j, point.at[2] += 2 * k;
    return point;
  };
  if (!is_cut()) {
    GridPoints corners;
    for (const int k : {0, 1})
      for (const auto& [i, j] : {std::array<int, 2>{0, 0}, {1, 0}, {1, 1}, {0, 1}}) corners.push_back(moved(start, i, j, k));
    return corners;
  }
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const auto part = static_cast<int>(element % 6);
  GridPoints corners{start};
  for (const int axis : orders[part]) {
    corners.push_back(corners.back());
    corners.back().at[axis] += 2;
  }
  if (part >= 3) std::swap(corners[1], corners[2]);  // odd orders run through a left-handed tetrahedron
  return corners;
}

CellNodes VolumeComplex::element_nodes(GlobalOrdinal element) const {
  const GridPoints corners = corners_of(element);
  CellNodes nodes;
  for (const GridPoint& corner : corners) nodes.push_back(node_at(corner));
  const CellTopology& cell = topology(shape_);
  for (int k = 0; k < cell.mid_side_nodes(); ++k) {
    const auto [a, b] = cell.edges[k];
    GridPoint middle = corners[a];
    for (int axis = 0; axis < 3; ++axis) middle.at[axis] = (corners[a].at[axis] + corners[b].at[axis]) / 2;
    nodes.push_back(node_at(middle));
  }
  return nodes;
}

std::vector<GlobalOrdinal> VolumeComplex::elements_of_node(GlobalOrdinal node) const {
  std::vector<GlobalOrdinal> elements;
  for (const auto& [b, at] : grid_points(node)) {
    const auto& cells = blocks_[b].cells;
    const auto first = [&at = at](int axis) { return std::max(0, (at[axis] - 1) / 2); };
    const auto last = [&at = at, &cells](int axis) { return std::min(at[axis] / 2, cells[axis] - 1); };
    for (int k = first(2); k <= last(2); ++k)
      for (int j = first(1); j <= last(1); ++j)
        for (int i = first(0); i <= last(0); ++i)
          for (int part = 0; part < elements_per_cell(); ++part) {
            const GlobalOrdinal cell = first_cell_[b] + i + cells[0] * (j + static_cast<GlobalOrdinal>(cells[1]) * k);
            const GlobalOrdinal element = cell * elements_per_cell() + part;
            if (is_cut()) {
              const auto nodes = element_nodes(element);
              if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) continue;
            }
            elements.push_back(element);
          }
  }
  std::sort(elements.begin(), elements.end());
  return elements;
}

std::vector<SurfaceSide> VolumeComplex::surface_sides(GlobalOrdinal element) const {
  const int b = cell_of(element).block;
  const GridPoints corners = corners_of(element);
  const auto& cell = topology(shape_);
  std::vector<SurfaceSide> sides;
  for (int side = 0; side < 6; ++side) {
    if (block_sides_[b][side] < 0) continue;
    for (int s = 0; s < static_cast<int>(cell.sides.size()); ++s) {
      const auto begin = cell.sides[s].nodes.begin(), end = begin + cell.sides[s].corners;
      if (std::all_of(begin, end, [&](int a) { return is_at(corners[a], side); })) sides.push_back({s, block_sides_[b][side]});
    }
  }
  return sides;
}

std::vector<int> VolumeComplex::sides_of_node(GlobalOrdinal node) const {
  std::vector<int> names;
  for (const GridPoint& point : grid_points(node))
    for (int side = 0; side < 6; ++side)
      if (block_sides_[point.block][side] >= 0 && is_at(point, side)) names.push_back(block_sides_[point.block][side]);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace mortise
