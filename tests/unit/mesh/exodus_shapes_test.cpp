// Elements of Exodus II, their nodes and their sides, beside what Exodus' own library says of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "exodus_test_support.hpp"
#include "mortise/mesh/cell_nodes.hpp"

namespace mortise {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ExodusShapes : public ::testing::TestWithParam<OneElement> {};

TEST_P(ExodusShapes, HaveTheirNodesAndSidesInOurOrder) {
  const OneElement& one = GetParam();
  for (const int mode : {EX_CLOBBER, EX_CLOBBER | EX_NETCDF4, EX_CLOBBER | EX_NETCDF4 | EX_ALL_INT64_DB}) {
    SCOPED_TRACE(mode);
    Exodus exodus = file_of(one);
    exodus.mode = mode;
    const MeshFile file = read_exodus_file(exodus);
    ASSERT_EQ(file.cells.size(), 1u);
    EXPECT_EQ(file.cells[0].shape, one.shape);
    const auto positions = reference_nodes(one.shape);
    for (std::size_t n = 0; n < positions.size(); ++n)
      EXPECT_EQ(file.coordinates[static_cast<std::size_t>(file.cells[0].nodes[n])], positions[n]) << "node " << n;
    expect_middles(file);
    EXPECT_THAT(names_of_sets(file.cell_sets), ElementsAre("block 40"));
    EXPECT_THAT(names_of_sets(file.side_sets), ElementsAre("side set 50"));
    const auto& sides = file.side_sets[0].members;
    ASSERT_EQ(sides.size(), static_cast<std::size_t>(one.sides));
    // The library itself says which nodes a side of a file has.
    std::vector<int> counts;
    const std::vector<int> nodes = nodes_of_sides(sides.size(), counts);
    std::size_t at = 0;
    for (std::size_t s = 0; s < sides.size(); ++s) {
      std::vector<std::array<double, 3>> theirs;
      const auto ours = corners_of(file, sides[s]);
      for (std::size_t n = 0; n < ours.size(); ++n) theirs.push_back(exodus.nodes[static_cast<std::size_t>(nodes[at + n] - 1)]);
      EXPECT_THAT(ours, ::testing::UnorderedElementsAreArray(theirs)) << "side " << s + 1;
      // Not counts[s]: the library says 7 for triangles of 6 nodes, and lists 6.
      at += topology(one.shape).sides[static_cast<std::size_t>(sides[s].side)].nodes.size();
    }
  }
}

// Exodus' manual has the nodes of upright edges of hexahedra before those of the top's.
INSTANTIATE_TEST_SUITE_P(
    All, ExodusShapes,
    ::testing::Values(OneElement{"HEX8", CellShape::hexahedron8, as_it_is(8), 6}, OneElement{"hex", CellShape::hexahedron8, as_it_is(8), 6},
                      OneElement{"HEX20", CellShape::hexahedron20, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15}, 6},
                      OneElement{"TETRA4", CellShape::tetrahedron4, as_it_is(4), 4}, OneElement{"TET10", CellShape::tetrahedron10, as_it_is(10), 4},
                      OneElement{"WEDGE6", CellShape::wedge6, as_it_is(6), 5},
                      OneElement{"WEDGE", CellShape::wedge15, {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11}, 5},
                      OneElement{"PYRAMID5", CellShape::pyramid5, as_it_is(5), 5}, OneElement{"TRI3", CellShape::triangle3, as_it_is(3), 3},
                      OneElement{"TRI6", CellShape::triangle6, as_it_is(6), 3}, OneElement{"QUAD4", CellShape::quadrilateral4, as_it_is(4), 4},
                      OneElement{"QUAD", CellShape::quadrilateral8, as_it_is(8), 4}),
    [](const auto& info) { return std::string(info.param.type) + std::to_string(info.param.order.size()); });

TEST(ExodusFiles, ShellsAreTheirOwnSides) {
  Exodus exodus = file_of({"SHELL4", CellShape::quadrilateral4, as_it_is(4), 2});
  exodus.dimension = 3;
  const MeshFile file = read_exodus_file(exodus);
  ASSERT_EQ(file.side_sets[0].members.size(), 2u);
  EXPECT_EQ(file.side_sets[0].members[0].side, the_cell_itself);
  EXPECT_EQ(file.side_sets[0].members[1].side, the_other_face);
  exodus.sides = {3, 6};
  exodus.side_elements = {1, 1};
  const auto edges = read_exodus_file(exodus).side_sets[0].members;
  EXPECT_EQ(edges[0].side, 0);
  EXPECT_EQ(edges[1].side, 3);
  exodus.sides = {7};
  exodus.side_elements = {1};
  EXPECT_THAT(exodus_refusal(exodus.write("a.exo")), HasSubstr("side set 50, member 1: element 1 of block 40 has no side 7; sides are 1 to 6"));
}

// Plane meshes are often written with three coordinates. Sides of quadrilaterals are their edges then, those of triangles as of shells: so does the
// library itself, which says which nodes a side has.
TEST(ExodusFiles, PlaneCellsInSpaceHaveTheSidesThatTheLibraryGivesThem) {
  for (const OneElement& one :
       {OneElement{"QUAD4", CellShape::quadrilateral4, as_it_is(4), 4}, OneElement{"QUAD8", CellShape::quadrilateral8, as_it_is(8), 4},
        OneElement{"TRI3", CellShape::triangle3, as_it_is(3), 5}, OneElement{"SHELL4", CellShape::quadrilateral4, as_it_is(4), 6}}) {
    SCOPED_TRACE(one.type);
    Exodus exodus = file_of(one);
    exodus.dimension = 3;
    const MeshFile file = read_exodus_file(exodus);
    const auto& sides = file.side_sets.at(0).members;
    ASSERT_EQ(sides.size(), static_cast<std::size_t>(one.sides));
    std::vector<int> counts;
    const std::vector<int> nodes = nodes_of_sides(sides.size(), counts);
    const CellTopology& cell = topology(one.shape);
    std::size_t at = 0;
    for (std::size_t s = 0; s < sides.size(); at += static_cast<std::size_t>(counts[s++])) {
      std::vector<int> ours;
      if (sides[s].side >= 0)
        ours = cell.sides[static_cast<std::size_t>(sides[s].side)].nodes;
      else
        for (int n = 0; n < cell.nodes; ++n) ours.push_back(n);
      ASSERT_EQ(ours.size(), static_cast<std::size_t>(counts[s])) << "side " << s + 1;
      std::vector<int> theirs(nodes.begin() + static_cast<std::ptrdiff_t>(at), nodes.begin() + static_cast<std::ptrdiff_t>(at) + counts[s]);
      for (int& node : theirs) --node;
      EXPECT_THAT(ours, ::testing::UnorderedElementsAreArray(theirs)) << "side " << s + 1;
      // A face against the normal has its corners the other way round.
      const auto corners = theirs.begin() + cell.corners;
      std::rotate(theirs.begin(), std::find(theirs.begin(), corners, 0), corners);
      if (sides[s].side < 0) EXPECT_EQ(theirs[1] == 1, sides[s].side == the_cell_itself) << "side " << s + 1;
    }
  }
}

}  // namespace
}  // namespace mortise
