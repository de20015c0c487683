// Cells whose nodes stand twice, as Abaqus, Cubit and sweeps of preprocessors write wedges and triangles.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_file_test_support.hpp"
#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

/// A deck of one cell, whose nodes `onto` (pairs, from 0) are others of it; nodes in the middle of edges lie in the middle. All its sides have sets.
std::string deck_of(const std::string& type, CellShape shape, const std::vector<std::array<int, 2>>& onto, int sides) {
  std::vector<std::array<double, 3>> places = reference_nodes(shape);
  std::vector<int> label(places.size());
  for (std::size_t n = 0; n < label.size(); ++n) label[n] = static_cast<int>(n);
  for (const auto& [from, to] : onto) {
    label[static_cast<std::size_t>(from)] = label[static_cast<std::size_t>(to)];
    places[static_cast<std::size_t>(from)] = places[static_cast<std::size_t>(to)];
  }
  const CellTopology& cell = topology(shape);
  for (int k = 0; k < cell.mid_side_nodes(); ++k) {
    const auto [a, b] = cell.edges[static_cast<std::size_t>(k)];
    auto& middle = places[static_cast<std::size_t>(cell.corners + k)];
    for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (places[static_cast<std::size_t>(a)][i] + places[static_cast<std::size_t>(b)][i]);
    int& own = label[static_cast<std::size_t>(cell.corners + k)];
    if (label[static_cast<std::size_t>(a)] == label[static_cast<std::size_t>(b)]) own = label[static_cast<std::size_t>(a)];
    for (int other = 0; other < k; ++other) {
      const auto [c, d] = cell.edges[static_cast<std::size_t>(other)];
      const auto is_same = [&](int x, int y) { return label[static_cast<std::size_t>(x)] == label[static_cast<std::size_t>(y)]; };
      if ((is_same(a, c) && is_same(b, d)) || (is_same(a, d) && is_same(b, c))) own = label[static_cast<std::size_t>(cell.corners + other)];
    }
  }
  std::string text = "*NODE\n", element = "7";
  for (std::size_t n = 0; n < places.size(); ++n) {
    if (label[n] == static_cast<int>(n)) {
      text += std::to_string(n + 1);
      for (const double x : places[n]) text += "," + std::to_string(x);
      text += "\n";
    }
    element += (n == 10 ? ",\n" : ",") + std::to_string(label[n] + 1);
  }
  text += "*ELEMENT, TYPE=" + type + ", ELSET=E\n" + element + "\n";
  for (int s = 1; s <= sides; ++s) text += "*SURFACE, NAME=S" + std::to_string(s) + "\nE, S" + std::to_string(s) + "\n";
  return text;
}

struct CollapsedCase {
  const char* type;
  CellShape shape;
  std::vector<std::array<int, 2>> onto;  ///< node, and the one that it is
  int sides;                             ///< of the shape
  CellShape wanted;
  std::size_t sets;  ///< that have a side in the end
};

void PrintTo(const CollapsedCase& one, std::ostream* stream) { *stream << one.type; }

class CollapsedCells : public ::testing::TestWithParam<CollapsedCase> {};

/// Corners of the sides of the file's sets that have any, each sorted by their places.
std::vector<std::vector<std::array<double, 3>>> corners_of_sets(const MeshFile& file) {
  std::vector<std::vector<std::array<double, 3>>> all;
  for (const auto& set : file.side_sets)
    for (const FileSide& side : set.members) {
      all.push_back(corners_of(file, side));
      std::sort(all.back().begin(), all.back().end());
    }
  return all;
}

TEST_P(CollapsedCells, HaveTheShapeThatIsLeft) {
  const CollapsedCase& one = GetParam();
  const MeshFile file = read_mesh_text("a.inp", deck_of(one.type, one.shape, one.onto, one.sides));
  const auto group = std::find_if(file.cells.begin(), file.cells.end(), [](const FileCells& cells) { return !cells.labels.empty(); });
  ASSERT_NE(group, file.cells.end());
  EXPECT_EQ(group->shape, one.wanted);
  EXPECT_THAT(group->labels, ElementsAre(7));
  EXPECT_GT(measure_of(file, file.cell_sets.at(0)), 0.0);  // by det J at each point: the cell is not inside out
  expect_middles(file);
  const auto sides = corners_of_sets(file);
  EXPECT_EQ(sides.size(), one.sets);
  // Each set has the corners that its face had, once each.
  const CellTopology& cell = topology(one.wanted);
  std::size_t counted = 0;
  for (const auto& set : file.side_sets) counted += set.members.size();
  EXPECT_EQ(counted, cell.sides.size());
  std::vector<int> numbers;
  for (const auto& set : file.side_sets)
    for (const FileSide& side : set.members) numbers.push_back(side.side);
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t s = 0; s < numbers.size(); ++s) EXPECT_EQ(numbers[s], static_cast<int>(s));
}

INSTANTIATE_TEST_SUITE_P(
    All, CollapsedCells,
    ::testing::Values(CollapsedCase{"C3D8", CellShape::hexahedron8, {{3, 2}, {7, 6}}, 6, CellShape::wedge6, 5},
                      CollapsedCase{"C3D8", CellShape::hexahedron8, {{1, 0}, {2, 3}}, 6, CellShape::wedge6, 5},
                      CollapsedCase{"C3D8", CellShape::hexahedron8, {{4, 0}, {7, 3}}, 6, CellShape::wedge6, 5},
                      CollapsedCase{"C3D8", CellShape::hexahedron8, {{5, 4}, {6, 4}, {7, 4}}, 6, CellShape::pyramid5, 5},
                      CollapsedCase{"C3D8", CellShape::hexahedron8, {{3, 2}, {5, 4}, {6, 4}, {7, 4}}, 6, CellShape::tetrahedron4, 4},
                      CollapsedCase{"C3D6", CellShape::wedge6, {{5, 2}}, 5, CellShape::pyramid5, 5},
                      CollapsedCase{"C3D6", CellShape::wedge6, {{4, 3}, {5, 3}}, 5, CellShape::tetrahedron4, 4},
                      CollapsedCase{"C3D20", CellShape::hexahedron20, {{3, 2}, {7, 6}}, 6, CellShape::wedge15, 5},
                      CollapsedCase{"C3D20", CellShape::hexahedron20, {{3, 2}, {5, 4}, {6, 4}, {7, 4}}, 6, CellShape::tetrahedron10, 4},
                      CollapsedCase{"C3D15", CellShape::wedge15, {{4, 3}, {5, 3}}, 5, CellShape::tetrahedron10, 4},
                      CollapsedCase{"CPE4", CellShape::quadrilateral4, {{3, 2}}, 4, CellShape::triangle3, 3},
                      CollapsedCase{"CPE4", CellShape::quadrilateral4, {{3, 0}}, 4, CellShape::triangle3, 3},
                      CollapsedCase{"CPE8", CellShape::quadrilateral8, {{1, 0}}, 4, CellShape::triangle6, 3}));

TEST(CollapsedCell, MovesTheOthersOfItsGroupUpAndTheirSetsWithThem) {
  // Three unit squares in a row; the one in the middle is a triangle, another triangle stands before all of them.
  const MeshFile file = read_mesh_text(
      "a.inp",
      "*NODE\n1,0\n2,1\n3,2\n4,3\n5,0,1\n6,1,1\n7,2,1\n8,3,1\n9,-1\n*ELEMENT, TYPE=CPE3, ELSET=T\n1, 9,1,5\n*ELEMENT, TYPE=CPE4, ELSET=Q\n"
      "11, 1,2,6,5\n12, 2,3,6,6\n13, 3,4,8,7\n*ELSET, ELSET=LAST\n12, 13\n*SURFACE, NAME=BOTTOM\nQ, S1\n*SURFACE, NAME=TOP\nQ, S3\n");
  EXPECT_THAT(file.cells.at(0).labels, ElementsAre(1, 12));
  EXPECT_THAT(file.cells.at(1).labels, ElementsAre(11, 13));
  EXPECT_THAT(file.cells.at(1).nodes, ElementsAre(0, 1, 5, 4, 2, 3, 7, 6));
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "Q")), 2.5, 1e-14);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "LAST")), 1.5, 1e-14);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "T")), 0.5, 1e-14);
  EXPECT_EQ(set_named(file.side_sets, "BOTTOM").members.size(), 3u);
  EXPECT_EQ(set_named(file.side_sets, "TOP").members.size(), 2u);
  EXPECT_THAT(file.notes, Contains("1 quadrilaterals have corners that stand twice: they are triangles"));
  EXPECT_THAT(file.notes, Contains("1 sides of sets are left out, as nothing but an edge is left of them"));
}

// A hexahedron becomes a wedge of a group that has wedges, one of which is a pyramid: what was added moves up too.
TEST(CollapsedCell, MovesUpWhereCellsThatWereAddedFollow) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
  const MeshFile file = read_mesh_text("a.inp", nodes +
                                                    "*ELEMENT, TYPE=C3D8, ELSET=H\n1, 1,2,3,3,5,6,7,7\n*ELEMENT, TYPE=C3D6, ELSET=W\n2, 1,2,4,5,6,4\n"
                                                    "*SURFACE, NAME=S\nH, S1\n");
  const FileCellRange range = set_named(file.cell_sets, "H").members.at(0);
  EXPECT_EQ(file.cells.at(static_cast<std::size_t>(range.group)).shape, CellShape::wedge6);
  EXPECT_EQ(file.cells[static_cast<std::size_t>(range.group)].labels.at(static_cast<std::size_t>(range.first)), 1);
  EXPECT_NEAR(measure_of(file, set_named(file.cell_sets, "H")), 0.5, 1e-14);
  EXPECT_EQ(corners_of(file, set_named(file.side_sets, "S").members.at(0)).size(), 3u);
}

TEST(CollapsedCell, OfNoOtherShapeStaysAsItIs) {
  const MeshFile file = read_mesh_text("a.inp", "*NODE\n1,0\n2,1\n3,1,1\n*ELEMENT, TYPE=CPE4\n11, 1,2,1,3\n");
  EXPECT_EQ(file.cells.at(0).shape, CellShape::quadrilateral4);
  EXPECT_THAT(file.cells[0].labels, ElementsAre(11));
}

}  // namespace
}  // namespace mortise
