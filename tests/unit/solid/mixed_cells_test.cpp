// Bodies of several kinds of cells that share their nodes.

#include <gtest/gtest.h>

#include "mortise/material/plane_stress.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

/// Cells into which a box of a lattice is cut. Joints have an apex in the middle: over sides that their neighbours do not cut are pyramids, over the
/// halves of the others tetrahedra.
enum class Box { hexahedron, wedges, tetrahedra, joint };

struct MixedCell {
  ElementType element;
  std::vector<LatticePoint> corners;
};

constexpr int boxes_along = 3;                          ///< an edge of the lattice
using Boxes = std::function<Box(const LatticePoint&)>;  ///< counted from 0

bool cuts(Box box, int direction) { return box == Box::tetrahedra || (box == Box::wedges && direction == 2); }

/// Over the sides of the box at `at`: pyramids or two tetrahedra each.
void add_joint(const Boxes& boxes, const LatticePoint& at, std::vector<MixedCell>& cells) {
  for (const CellSide& side : topology(CellShape::hexahedron8).sides) {
    std::vector<LatticePoint> base;
    for (int a = 3; a >= 0; --a) base.push_back(lowest_box[side.nodes[a]]);
    int direction = 0;
    while (base[0][direction] != base[2][direction]) ++direction;
    LatticePoint beyond = at;
    beyond[direction] += base[0][direction] == 0 ? -1 : 1;
    const bool is_outer = beyond[direction] < 0 || beyond[direction] >= boxes_along;
    if (is_outer || !cuts(boxes(beyond), direction)) {
      cells.push_back({ElementType::p5, {base[0], base[1], base[2], base[3], {1, 1, 1}}});
      continue;
    }
    std::rotate(base.begin(), std::min_element(base.begin(), base.end()), base.end());  // the diagonal starts at the lowest corner
    cells.push_back({ElementType::tet4, {base[0], base[1], base[2], {1, 1, 1}}});
    cells.push_back({ElementType::tet4, {base[0], base[2], base[3], {1, 1, 1}}});
  }
}

std::vector<MixedCell> cells_of_boxes(const Boxes& boxes, bool quadratic) {
  std::vector<MixedCell> cells;
  for (int k = 0; k < boxes_along; ++k)
    for (int j = 0; j < boxes_along; ++j)
      for (int i = 0; i < boxes_along; ++i) {
        const std::size_t first = cells.size();
        const auto add = [&](ElementType element) {
          for (const auto& corners : cells_of_a_box(cell_shape(element))) cells.push_back({element, corners});
        };
        const Box box = boxes({i, j, k});
        if (box == Box::hexahedron) add(quadratic ? ElementType::h20 : ElementType::h8);
        if (box == Box::wedges) add(quadratic ? ElementType::w15 : ElementType::w6);
        if (box == Box::tetrahedra) add(quadratic ? ElementType::tet10 : ElementType::tet4);
        if (box == Box::joint) add_joint(boxes, {i, j, k}, cells);
        for (std::size_t c = first; c < cells.size(); ++c)
          for (LatticePoint& corner : cells[c].corners) corner = {corner[0] + 2 * i, corner[1] + 2 * j, corner[2] + 2 * k};
      }
  return cells;
}

struct MixedMesh {
  RCP<Mesh> mesh;                       ///< a block for each kind of element
  std::vector<ElementType> elements;    ///< of the blocks
  std::vector<LocalOrdinal> inside;     ///< nodes inside the lattice
  std::vector<LatticePoint> positions;  ///< [nodes]
};

/// The lattice, pushed out of shape; mid-side nodes stay in the middle of their edges.
MixedMesh make_mixed_mesh(const std::vector<MixedCell>& cells) {
  MixedMesh mixed;
  mixed.mesh = rcp(new Mesh);
  Mesh& mesh = *mixed.mesh;
  mesh.dimension = 3;
  mesh.comm = self();
  const auto moved = [](const LatticePoint& point) -> Point3 {
    const Eigen::Vector3d s = Eigen::Vector3d(point[0], point[1], point[2]) / (2.0 * boxes_along);
    constexpr double distortion = 0.2 / boxes_along;
    return {s(0) + distortion * std::cos(1.0 + 7.0 * s(1) - 5.0 * s(2)), s(1) + distortion * std::sin(6.0 * s(0) + 4.0 * s(2)),
            s(2) + distortion * std::sin(1.0 + 5.0 * s(0) - 8.0 * s(1))};
  };
  std::map<LatticePoint, LocalOrdinal> nodes;
  const auto node_at = [&](const LatticePoint& point, const Point3& X) {
    const auto [entry, is_new] = nodes.try_emplace(point, static_cast<LocalOrdinal>(nodes.size()));
    if (is_new) {
      mesh.coordinates.push_back(X);
      mixed.positions.push_back(point);
    }
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(mesh.coordinates[entry->second][i], X[i], 1e-15) << "cells that share an edge have one node in its middle";
    return entry->second;
  };
  GlobalOrdinal next = 0;
  for (const MixedCell& cell : cells) {
    const CellTopology& shape = topology(cell_shape(cell.element));
    const auto found = std::find(mixed.elements.begin(), mixed.elements.end(), cell.element);
    const auto b = static_cast<std::size_t>(found - mixed.elements.begin());
    if (found == mixed.elements.end()) {
      mixed.elements.push_back(cell.element);
      Block block;
      block.shape = cell_shape(cell.element);
      block.nodes_per_element = shape.nodes;
      mesh.blocks.push_back(block);
    }
    Block& block = mesh.blocks[b];
    for (const LatticePoint& corner : cell.corners) block.connectivity.push_back(node_at(corner, moved(corner)));
    for (int k = 0; k < shape.mid_side_nodes(); ++k) {
      const LatticePoint &one = cell.corners[shape.edges[k][0]], &other = cell.corners[shape.edges[k][1]];
      LatticePoint middle;
      Point3 X;
      for (int i = 0; i < 3; ++i) {
        middle[i] = (one[i] + other[i]) / 2;
        X[i] = 0.5 * (moved(one)[i] + moved(other)[i]);
      }
      block.connectivity.push_back(node_at(middle, X));
    }
    block.element_ids.push_back(next++);
    ++block.owned;
  }
  mesh.owned_nodes = mesh.local_nodes = rcp(new Map(nodes.size(), 0, mesh.comm));
  mesh.bodies = {{"mixed", false}};
  mesh.body_of_node.assign(nodes.size(), 0);
  for (const auto& [point, node] : nodes)
    if (std::all_of(point.begin(), point.end(), [](int s) { return s > 0 && s < 2 * boxes_along; })) mixed.inside.push_back(node);
  return mixed;
}

/// Corners of a side in their order, from the lowest on.
std::vector<LocalOrdinal> cycle_of(const Block& block, LocalOrdinal element, const CellSide& side) {
  std::vector<LocalOrdinal> cycle;
  for (int a = 0; a < side.corners; ++a) cycle.push_back(block.nodes(element)[side.nodes[a]]);
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  return cycle;
}

/// Each side is that of a neighbour, run through the other way, or lies on the surface of the lattice.
void expect_conforming(const MixedMesh& mixed) {
  std::set<std::vector<LocalOrdinal>> sides;
  for (const Block& block : mixed.mesh->blocks)
    for (LocalOrdinal element = 0; element < block.size(); ++element)
      for (const CellSide& side : topology(block.shape).sides) EXPECT_TRUE(sides.insert(cycle_of(block, element, side)).second);
  for (const auto& side : sides) {
    auto reversed = side;
    std::reverse(reversed.begin() + 1, reversed.end());
    bool is_outer = false;
    for (int i = 0; i < 3; ++i)
      for (const int end : {0, 2 * boxes_along})
        is_outer = is_outer || std::all_of(side.begin(), side.end(), [&, i = i](LocalOrdinal node) { return mixed.positions[node][i] == end; });
    EXPECT_NE(sides.count(reversed) == 1, is_outer);
  }
}

/// Constant strain, in equilibrium at all nodes inside, seen by all points and at all nodes.
void expect_constant_strain(const MixedMesh& mixed, const std::string& law_name) {
  std::vector<BodyProperties> properties;
  for (std::size_t b = 0; b < mixed.elements.size(); ++b)
    properties.push_back({mixed.mesh->bodies.front().name, {}, make_material(law_name), mixed.elements[b]});
  const Bodies bodies(displacement_space(mixed.mesh), Kinematics::three_dimensional, 1.0, properties);
  Matrix3 F;
  F << 1.1, 0.06, -0.03, -0.04, 0.92, 0.05, 0.02, -0.07, 1.05;
  const Eigen::VectorXd u = space_field(bodies, [&](const Point3& X) -> Point3 {
    const Eigen::Vector3d moved = (F - Matrix3::Identity()) * Eigen::Map<const Eigen::Vector3d>(X.data());
    return {moved(0), moved(1), moved(2)};
  });
  const Eigen::VectorXd force = internal_force(bodies, u);
  const double scale = force.cwiseAbs().maxCoeff();
  ASSERT_FALSE(mixed.inside.empty());
  for (const LocalOrdinal node : mixed.inside) EXPECT_LE(force.segment<3>(3 * node).cwiseAbs().maxCoeff(), 1e-12 * scale);
  std::visit(
      [&](const auto& law) {
        const Matrix3 cauchy = Unconstrained<std::decay_t<decltype(law)>>{law}.stress(F, {}) / (law.small_strain ? 1.0 : F.determinant());
        bodies.visit_points(to_local(bodies, u), [&](const MaterialPoint& point) {
          EXPECT_LE((point.deformation_gradient - F).norm(), 1e-13);
          EXPECT_LE((point.cauchy_stress - cauchy).norm(), 1e-12 * 1000.0);
        });
        const std::array<double, 6> expected{cauchy(0, 0), cauchy(1, 1), cauchy(2, 2), cauchy(0, 1), cauchy(1, 2), cauchy(0, 2)};
        const auto nodal = bodies.nodal_stresses(to_local(bodies, u));
        const auto view = nodal->getLocalViewHost(Tpetra::Access::ReadOnly);
        for (int c = 0; c < 6; ++c)
          for (LocalOrdinal node = 0; node < mixed.mesh->owned_count(); ++node) EXPECT_NEAR(view(node, c), expected[c], 1e-12 * 1000.0);
      },
      make_material(law_name)->law());
}

TEST(MixedCells, OfAllLinearKindsPassThePatchTest) {
  // Tetrahedra at x = 2, before them joints; at x = 0 hexahedra and wedges, of which one has a joint above it.
  const Boxes boxes = [](const LatticePoint& at) {
    if (at[0] == 2) return Box::tetrahedra;
    if (at[0] == 1 || (at[1] == 1 && at[2] == 2)) return Box::joint;
    return at[1] == 0 ? Box::hexahedron : Box::wedges;
  };
  const MixedMesh mixed = make_mixed_mesh(cells_of_boxes(boxes, false));
  EXPECT_EQ(std::set<ElementType>(mixed.elements.begin(), mixed.elements.end()),
            (std::set<ElementType>{ElementType::h8, ElementType::w6, ElementType::p5, ElementType::tet4}));
  expect_conforming(mixed);
  for (const auto& material : material_registry().entries()) {
    SCOPED_TRACE(material.name);
    expect_constant_strain(mixed, material.name);
  }
}

TEST(MixedCells, OfQuadraticKindsPassThePatchTest) {
  // Hexahedra beside wedges, and wedges below tetrahedra: between hexahedra and tetrahedra there would have to be pyramids.
  for (const Boxes& boxes : {Boxes([](const LatticePoint& at) { return at[0] == 1 ? Box::hexahedron : Box::wedges; }),
                             Boxes([](const LatticePoint& at) { return at[2] == 1 ? Box::tetrahedra : Box::wedges; })}) {
    const MixedMesh mixed = make_mixed_mesh(cells_of_boxes(boxes, true));
    EXPECT_EQ(mixed.elements.size(), 2u);
    expect_conforming(mixed);
    expect_constant_strain(mixed, "hencky");
  }
}

}  // namespace
}  // namespace mortise
