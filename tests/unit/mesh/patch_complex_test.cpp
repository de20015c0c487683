// The pure descriptions of all kinds of meshes: topology, numbering, sides, inverse connectivity.

#include "mortise/mesh/patch_complex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mesh_test_support.hpp"

namespace mortise {
namespace {

struct Case {
  std::string name;
  PatchComplex complex;
  std::vector<std::string> sides;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& mesh : example_meshes())
    for (const auto& [cell, what] : {std::pair{CellShape::quadrilateral4, " of quadrilaterals"},
                                     {CellShape::triangle3, " of triangles"},
                                     {CellShape::quadrilateral8, " of quadratic quadrilaterals"},
                                     {CellShape::triangle6, " of quadratic triangles"}})
      all.push_back({mesh.name + what, mesh.options->build(cell, {}), mesh.sides});
  return all;
}

TEST(PatchComplex, NamedSidesAreExactlyTheSurface) {
  for (const auto& [name, complex, sides] : cases()) {
    SCOPED_TRACE(name);
    auto names = complex.side_names();
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, sides);
    // Directed sides: inner ones are run through once in each direction, those of the surface once.
    const auto& cell = topology(complex.shape());
    std::set<std::pair<GlobalOrdinal, GlobalOrdinal>> directed, surface;
    std::set<GlobalOrdinal> corners;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      corners.insert(nodes.begin(), nodes.begin() + cell.corners);
      for (const CellSide& side : cell.sides) EXPECT_TRUE(directed.emplace(nodes[side.nodes[0]], nodes[side.nodes[1]]).second);
      for (const auto& side : complex.surface_sides(e)) {
        const auto& ends = cell.sides[side.side].nodes;
        surface.emplace(nodes[ends[0]], nodes[ends[1]]);
      }
    }
    std::size_t undirected = 0;
    for (const auto& [a, b] : directed) {
      EXPECT_EQ(directed.count({b, a}) == 0, surface.count({a, b}) == 1) << a << " to " << b;
      if (a < b || directed.count({b, a}) == 0) ++undirected;
    }
    // A disk has Euler's characteristic 1: no hole, no seam left open.
    EXPECT_EQ(static_cast<GlobalOrdinal>(corners.size()) - static_cast<GlobalOrdinal>(undirected) + complex.element_count(), 1);
    // Quadratic cells have one node more for each of their sides.
    EXPECT_EQ(complex.node_count() - static_cast<GlobalOrdinal>(corners.size()),
              cell.nodes == cell.corners ? 0 : static_cast<GlobalOrdinal>(undirected));
  }
}

TEST(PatchComplex, CellsRunCounterclockwiseAndPositionsDiffer) {
  for (const auto& [name, complex, sides] : cases()) {
    SCOPED_TRACE(name);
    std::set<Point> positions;
    for (GlobalOrdinal n = 0; n < complex.node_count(); ++n) EXPECT_TRUE(positions.insert(complex.coordinate(n)).second) << "node " << n;
    const int corners = topology(complex.shape()).corners;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      for (int a = 0; a < corners; ++a) {
        const Point x = complex.coordinate(nodes[a]), y = complex.coordinate(nodes[(a + 1) % corners]);
        const Point z = complex.coordinate(nodes[(a + corners - 1) % corners]);
        EXPECT_GT((y[0] - x[0]) * (z[1] - x[1]) - (y[1] - x[1]) * (z[0] - x[0]), 0.0) << "element " << e;
      }
    }
  }
}

TEST(PatchComplex, ElementsAndSidesOfNodesInvertTheConnectivity) {
  for (const auto& [name, complex, sides] : cases()) {
    SCOPED_TRACE(name);
    const auto& cell = topology(complex.shape());
    std::map<GlobalOrdinal, std::vector<GlobalOrdinal>> elements;
    std::map<GlobalOrdinal, std::set<int>> names;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      for (int a = 0; a < cell.nodes; ++a) elements[nodes[a]].push_back(e);
      for (const auto& side : complex.surface_sides(e))
        for (const int a : cell.sides[side.side].nodes) names[nodes[a]].insert(side.name);
    }
    ASSERT_EQ(static_cast<GlobalOrdinal>(elements.size()), complex.node_count());
    for (GlobalOrdinal n = 0; n < complex.node_count(); ++n) {
      EXPECT_EQ(complex.elements_of_node(n), elements[n]) << "node " << n;
      EXPECT_THAT(complex.sides_of_node(n), ::testing::ElementsAreArray(names[n])) << "node " << n;
    }
  }
}

TEST(PatchComplex, CellsThatShareASideShareItsMiddle) {
  for (const auto& [name, complex, sides] : cases()) {
    const auto& cell = topology(complex.shape());
    if (cell.nodes == cell.corners) continue;
    SCOPED_TRACE(name);
    std::map<std::pair<GlobalOrdinal, GlobalOrdinal>, GlobalOrdinal> middles;
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      for (const CellSide& side : cell.sides) {
        const GlobalOrdinal a = nodes[side.nodes[0]], b = nodes[side.nodes[1]], middle = nodes[side.nodes[2]];
        EXPECT_EQ(middles.try_emplace({std::min(a, b), std::max(a, b)}, middle).first->second, middle);
      }
    }
  }
}

TEST(PatchComplex, MiddlesOfARectangleWithGradedCellsHalveTheirSides) {
  BlockMesh block;
  block.cells_x = 4;
  block.cells_y = 3;
  block.grading_x.ratio = 5.0;
  for (const auto shape : {CellShape::quadrilateral8, CellShape::triangle6}) {
    const auto complex = block.build(shape, {});
    for (GlobalOrdinal e = 0; e < complex.element_count(); ++e) {
      const auto nodes = complex.element_nodes(e);
      for (const CellSide& side : topology(shape).sides) {
        const Point a = complex.coordinate(nodes[side.nodes[0]]), b = complex.coordinate(nodes[side.nodes[1]]);
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(complex.coordinate(nodes[side.nodes[2]])[i], 0.5 * (a[i] + b[i]), 1e-15);
      }
    }
  }
}

TEST(PatchComplex, PatchesMeetWhateverTheDirectionOfTheirSharedEdge) {
  // Two unit squares; the edge between them is graded and once given upward, once downward.
  for (const bool downward : {false, true}) {
    const Spacing two(2), graded({{3, 1.0, 2.0}});
    std::vector<PatchComplex::Edge> edges{{0, 1, two}, {1, 2, two}, {5, 4, two}, {4, 3, two}, {0, 5, Spacing(3)}, {2, 3, Spacing(3)}};
    edges.push_back(downward ? PatchComplex::Edge{4, 1, graded.reversed()} : PatchComplex::Edge{1, 4, graded});
    const PatchComplex complex(CellShape::quadrilateral4, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}, edges,
                               {{{0, 1, 4, 5}, {"a", "", "b", "c"}}, {{1, 2, 3, 4}, {"a", "d", "b", ""}}}, {});
    EXPECT_EQ(complex.node_count(), 5 * 4);
    std::vector<double> heights;
    for (GlobalOrdinal n = 0; n < complex.node_count(); ++n)
      if (const Point x = complex.coordinate(n); std::abs(x[0] - 1.0) < 1e-12) heights.push_back(x[1]);
    std::sort(heights.begin(), heights.end());
    ASSERT_EQ(heights.size(), 4u);
    EXPECT_NEAR(heights[1], 1.0 / 7.0, 1e-14);
    EXPECT_NEAR(heights[2], 3.0 / 7.0, 1e-14);
  }
}

TEST(PatchComplex, RefusesPatchesThatDoNotFit) {
  const std::vector<Point> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<PatchComplex::Patch> patch{{{0, 1, 2, 3}, {"a", "b", "c", "d"}}};
  const Spacing two(2), three(3);
  EXPECT_THROW(PatchComplex(CellShape::triangle3, square, {{0, 1, two}, {1, 2, two}, {3, 2, two}}, patch, {}), std::logic_error);
  EXPECT_THROW(PatchComplex(CellShape::triangle3, square, {{0, 1, two}, {1, 2, two}, {3, 2, three}, {0, 3, two}}, patch, {}), std::logic_error);
}

TEST(Placement, RotatesAboutTheOriginAndThenMoves) {
  const Placement placement{90.0, {10.0, 20.0}};
  const Point x = placement({1.0, 2.0});
  EXPECT_NEAR(x[0], 8.0, 1e-14);
  EXPECT_NEAR(x[1], 21.0, 1e-14);
}

}  // namespace
}  // namespace mortise
