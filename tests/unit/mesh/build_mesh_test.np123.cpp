// Distributed meshes: areas, sides, ownership, ghosts; the same for every number of ranks; errors.

#include "mortise/mesh/build_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <cmath>

#include "mesh_test_support.hpp"

namespace mortise {
namespace {

double sum(const Mesh& mesh, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

// Shoelace formula: exact for elements with straight sides.
double area(const Mesh& mesh) {
  double mine = 0.0;
  for (const Block& block : mesh.blocks)
    for (LocalOrdinal e = 0; e < block.owned; ++e)
      for (int a = 0; a < block.nodes_per_element; ++a) {
        const auto& p = mesh.coordinates[block.nodes(e)[a]];
        const auto& q = mesh.coordinates[block.nodes(e)[(a + 1) % block.nodes_per_element]];
        mine += 0.5 * (p[0] * q[1] - p[1] * q[0]);
      }
  return sum(mesh, mine);
}

double length(const Mesh& mesh, const std::string& name) {
  const SideSet& set = mesh.side_sets.at(name);
  double mine = 0.0;
  for (LocalOrdinal s = 0; s < set.owned; ++s) {
    const auto nodes = mesh.side_nodes(set.sides[s]);
    const auto &a = mesh.coordinates[nodes[0]], &b = mesh.coordinates[nodes[1]];
    mine += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  return sum(mesh, mine);
}

std::shared_ptr<BlockMesh> block(double width, double height, int nx, int ny) {
  auto result = std::make_shared<BlockMesh>();
  result->width = width;
  result->height = height;
  result->cells_x = nx;
  result->cells_y = ny;
  return result;
}

TEST(BuildMesh, CountsAreasAndSidesOfTwoBodies) {
  const auto comm = Tpetra::getDefaultComm();
  auto upper = block(4.0, 2.0, 5, 3);
  upper->translation = {0.0, 2.0};
  const auto mesh = build_mesh(comm, {{"upper", {}, upper, CellShape::quadrilateral4}, {"lower", {}, block(4.0, 2.0, 7, 3), CellShape::triangle3}},
                               {"upper/bottom", "lower/top"});
  const MeshSize size = mesh_size(*mesh);
  EXPECT_EQ(size.nodes, 6 * 4 + 8 * 4);
  EXPECT_EQ(size.elements, 15 + 42);
  EXPECT_NEAR(area(*mesh), 16.0, 1e-12);
  for (const char* side : {"upper/bottom", "upper/top", "lower/bottom", "lower/top"}) EXPECT_NEAR(length(*mesh, side), 4.0, 1e-12);
  EXPECT_NEAR(length(*mesh, "upper/left"), 2.0, 1e-12);
  // The outward normal (t_y, -t_x) of a top points up, of a bottom down.
  for (const auto& [name, up] : std::vector<std::pair<std::string, double>>{{"lower/top", 1.0}, {"upper/bottom", -1.0}})
    for (const Side& side : mesh->side_sets.at(name).sides) {
      const auto nodes = mesh->side_nodes(side);
      EXPECT_GT(-up * (mesh->coordinates[nodes[1]][0] - mesh->coordinates[nodes[0]][0]), 0.0);
    }
}

TEST(BuildMesh, OwnedNodesHaveAllTheirElementsHere) {
  const auto comm = Tpetra::getDefaultComm();
  const auto mesh = build_mesh(comm, {{"body", {}, block(3.0, 2.0, 12, 9), CellShape::quadrilateral4}}, {});
  EXPECT_TRUE(mesh->owned_nodes->isOneToOne());
  std::vector<int> touched(mesh->local_count(), 0);
  const Block& body = mesh->blocks[0];
  for (LocalOrdinal e = 0; e < body.size(); ++e)
    for (int a = 0; a < 4; ++a) ++touched[body.nodes(e)[a]];
  for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node) {
    const auto& X = mesh->coordinates[node];
    const bool at_x = X[0] < 1e-9 || X[0] > 3.0 - 1e-9, at_y = X[1] < 1e-9 || X[1] > 2.0 - 1e-9;
    EXPECT_EQ(touched[node], (at_x ? 1 : 2) * (at_y ? 1 : 2));
  }
  // Every element here has a node that this rank owns, or is owned itself.
  for (LocalOrdinal e = body.owned; e < body.size(); ++e) {
    bool owned = false;
    for (int a = 0; a < 4; ++a) owned |= body.nodes(e)[a] < mesh->owned_count();
    EXPECT_TRUE(owned);
  }
}

TEST(BuildMesh, IsTheSameOnAnyNumberOfRanks) {
  for (const auto cell : {CellShape::triangle3, CellShape::quadrilateral8, CellShape::triangle6}) {
    const auto bodies = all_kinds(cell);
    const auto mesh = build_mesh(Tpetra::getDefaultComm(), bodies, {"quarter disk/arc", "block/top"});
    const auto whole = build_mesh(rcp(new Teuchos::SerialComm<int>()), bodies, {});
    GlobalOrdinal first = 0;
    for (std::size_t b = 0; b < mesh->blocks.size(); ++b) {
      const auto &block = mesh->blocks[b], &all = whole->blocks[b];
      EXPECT_EQ(mesh_size(*mesh).elements_of_block[b], all.size());
      for (LocalOrdinal e = 0; e < block.size(); ++e) {
        const GlobalOrdinal inside = block.element_ids[e] - first;
        ASSERT_TRUE(inside >= 0 && inside < all.size());
        for (int a = 0; a < block.nodes_per_element; ++a)
          EXPECT_EQ(mesh->local_nodes->getGlobalElement(block.nodes(e)[a]),
                    whole->local_nodes->getGlobalElement(all.nodes(static_cast<LocalOrdinal>(inside))[a]));
      }
      first += all.size();
    }
    for (LocalOrdinal node = 0; node < mesh->local_count(); ++node)
      EXPECT_EQ(mesh->coordinates[node], whole->coordinates[whole->local_nodes->getLocalElement(mesh->local_nodes->getGlobalElement(node))]);
    const MeshSize size = mesh_size(*mesh), reference = mesh_size(*whole);
    EXPECT_EQ(size.nodes, reference.nodes);
    EXPECT_EQ(size.elements, first);
    EXPECT_EQ(size.length, reference.length);
    EXPECT_EQ(size.shortest_side, reference.shortest_side);
  }
}

TEST(BuildMesh, RefusesBodiesWithoutMeaningOnEveryRank) {
  using ::testing::HasSubstr;
  const auto comm = Tpetra::getDefaultComm();
  const Place place{"scene.xml", 5, "bodies/die"};
  auto crossed = std::make_shared<BlockMesh>();
  crossed->corners = {0.0, 0.0, 1.0, 0.0, 0.4, 0.4, 0.0, 1.0};  // a reentrant corner: only the cells next to it are inverted
  crossed->cells_x = crossed->cells_y = 8;
  EXPECT_THAT(input_error_of([&] {
                build_mesh(comm, {{"die", place, crossed, CellShape::quadrilateral4}}, {});
              }),
              ::testing::AllOf(HasSubstr("scene.xml:5: error: bodies/die"), HasSubstr("body \"die\": element "), HasSubstr("det J = -")));
  const auto good = example_meshes()[1].options;
  EXPECT_THAT(input_error_of([&] {
                build_mesh(comm, {{"die", {}, good, {}}, {"die", place, good, {}}}, {});
              }),
              HasSubstr("already a body named \"die\""));
  EXPECT_THAT(input_error_of([&] { build_mesh(comm, {}, {}); }), HasSubstr("no body"));
}

TEST(BuildMesh, HoldsFewerElementsThanRanks) {
  auto block = std::make_shared<BlockMesh>();
  block->cells_x = block->cells_y = 1;
  const auto mesh = build_mesh(Tpetra::getDefaultComm(), {{"body", {}, block, CellShape::quadrilateral4}}, {"body/top"});
  EXPECT_EQ(mesh_size(*mesh).nodes, 4);
  EXPECT_EQ(mesh_size(*mesh).elements, 1);
}

}  // namespace
}  // namespace mortise
