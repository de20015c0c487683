// The pure descriptions of all kinds of 3D bodies: conformity, orientation, volumes, numbering, sides, inverse connectivity.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "volume_test_support.hpp"

namespace mortise {
namespace {

/// check(complex, example) for every kind, of all cells that it can be made of.
template <class Check>
void for_all(const Check& check) {
  for (const auto& example : example_volumes())
    for (const auto cell : cells_of(*example.options)) {
      SCOPED_TRACE(example.name + " of cells with " + std::to_string(topology(cell).nodes) + " nodes");
      with_volume(*example.options, cell, [&](const auto& complex) { check(complex, example); });
    }
}

template <class Complex, class Nodes>
Positions positions(const Complex& complex, const Nodes& nodes) {
  Positions x;
  for (const GlobalOrdinal node : nodes) x.push_back(Eigen::Vector3d::Map(complex.coordinate(node).data()));
  return x;
}

using Cycle = std::vector<GlobalOrdinal>;

/// The corners of a side of the cell in their order, from the lowest on.
Cycle cycle_of(const CellTopology& cell, int side, const CellNodes& nodes) {
  Cycle cycle;
  for (int a = 0; a < cell.sides[side].corners; ++a) cycle.push_back(nodes[cell.sides[side].nodes[a]]);
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
  return cycle;
}

Cycle reversed(Cycle cycle) {
  std::reverse(cycle.begin() + 1, cycle.end());
  return cycle;
}

TEST(VolumeComplex, NamedSidesAreExactlyTheSurface) {
  for_all([](const auto& complex, const ExampleVolume& example) {
    auto names = complex.side_names();
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, example.sides);
    const auto& cell = topology(complex.shape());
    const bool is_quadratic = cell.nodes > cell.corners;
    std::set<Cycle> sides, surface;
    std::map<std::pair<GlobalOrdinal, GlobalOrdinal>, GlobalOrdinal> edges;  // and the nodes in their middle
    std::set<GlobalOrdinal> corners;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      corners.insert(nodes.begin(), nodes.begin() + cell.corners);
      for (int s = 0; s < static_cast<int>(cell.sides.size()); ++s) {
        EXPECT_TRUE(sides.insert(cycle_of(cell, s, nodes)).second) << "a side that two cells run through in the same direction";
        const auto& side = cell.sides[s].nodes;
        const int ends = cell.sides[s].corners;
        for (int a = 0; a < ends; ++a) {
          const GlobalOrdinal p = nodes[side[a]], q = nodes[side[(a + 1) % ends]], middle = is_quadratic ? nodes[side[ends + a]] : -1;
          EXPECT_EQ(edges.try_emplace({std::min(p, q), std::max(p, q)}, middle).first->second, middle);
        }
      }
      for (const auto& side : complex.surface_sides(e)) EXPECT_TRUE(surface.insert(cycle_of(cell, side.side, nodes)).second);
    }
    std::size_t faces = 0;
    for (const Cycle& side : sides) {
      const bool is_inner = sides.count(reversed(side)) == 1;
      EXPECT_NE(is_inner, surface.count(side) == 1);
      if (!is_inner || side < reversed(side)) ++faces;
    }
    // A ball has Euler's characteristic 1: no hole, no seam left open.
    const auto count = [](std::size_t n) { return static_cast<GlobalOrdinal>(n); };
    EXPECT_EQ(count(corners.size()) - count(edges.size()) + count(faces) - complex.element_count(), 1);
    // Quadratic cells have one node more for each of their edges.
    EXPECT_EQ(complex.node_count(), count(corners.size()) + (is_quadratic ? count(edges.size()) : 0));
  });
}

TEST(VolumeComplex, CellsArePositiveAndFillTheVolumeThatTheSurfaceEncloses) {
  for_all([](const auto& complex, const ExampleVolume& example) {
    const auto& cell = topology(complex.shape());
    double volume = 0.0, enclosed = 0.0;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      volume += volume_of_cell(complex.shape(), positions(complex, nodes));
      for (const auto& side : complex.surface_sides(e)) {
        std::vector<GlobalOrdinal> facet;
        for (const int a : cell.sides[side.side].nodes) facet.push_back(nodes[a]);
        enclosed += volume_below_facet(cell.sides[side.side].shape, positions(complex, facet));
      }
    }
    const bool has_curved_cells = cell.nodes > cell.corners && example.name != "brick";
    if (example.volume > 0.0 && !has_curved_cells) EXPECT_NEAR(volume, example.volume, 1e-12 * example.volume);
    EXPECT_NEAR(enclosed, volume, 1e-12 * volume);
  });
}

TEST(VolumeComplex, ElementsAndSidesOfNodesInvertTheConnectivity) {
  for_all([](const auto& complex, const ExampleVolume&) {
    const auto& cell = topology(complex.shape());
    std::map<GlobalOrdinal, std::vector<GlobalOrdinal>> elements;
    std::map<GlobalOrdinal, std::set<int>> names;
    std::set<SpatialPoint> positions;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      ASSERT_EQ(static_cast<int>(nodes.size()), cell.nodes);
      for (const GlobalOrdinal node : nodes) elements[node].push_back(e);
      for (const auto& side : complex.surface_sides(e))
        for (const int a : cell.sides[side.side].nodes) names[nodes[a]].insert(side.name);
    }
    ASSERT_EQ(static_cast<GlobalOrdinal>(elements.size()), complex.node_count());
    for (GlobalOrdinal n = 0; n < complex.node_count(); ++n) {
      EXPECT_EQ(complex.elements_of_node(n), elements[n]) << "node " << n;
      EXPECT_THAT(complex.sides_of_node(n), ::testing::ElementsAreArray(names[n])) << "node " << n;
      EXPECT_TRUE(positions.insert(complex.coordinate(n)).second) << "node " << n;
    }
  });
}

TEST(VolumeComplex, RefusesBlocksThatRunThroughASharedFaceDifferently) {
  const auto position = [](const VolumeComplex::GridPoint&) { return SpatialPoint{}; };
  const auto build = [&](const std::array<int, 8>& second, const std::array<int, 3>& cells) {
    VolumeComplex(CellShape::hexahedron8, {{{0, 1, 2, 3, 4, 5, 6, 7}, {2, 3, 4}, {}}, {second, cells, {}}}, position, {});
  };
  EXPECT_NO_THROW(build({1, 8, 3, 9, 5, 10, 7, 11}, {5, 3, 4}));
  EXPECT_NO_THROW(build({1, 3, 8, 9, 5, 7, 10, 11}, {3, 5, 4}));                 // the face's directions in another order
  EXPECT_THROW(build({1, 8, 3, 9, 5, 10, 7, 11}, {5, 3, 3}), std::logic_error);  // other cells
  EXPECT_THROW(build({3, 9, 1, 8, 7, 11, 5, 10}, {5, 3, 4}), std::logic_error);  // the other way round
}

TEST(VolumeComplex, RefusesCellsThatBlocksAreNotCutInto) {
  for (const auto cell : {CellShape::wedge6, CellShape::wedge15, CellShape::pyramid5, CellShape::quadrilateral4})
    EXPECT_THROW(VolumeComplex(cell, {{{0, 1, 2, 3, 4, 5, 6, 7}, {2, 3, 4}, {}}}, [](const VolumeComplex::GridPoint&) { return SpatialPoint{}; }, {}),
                 std::logic_error);
}

}  // namespace
}  // namespace mortise
