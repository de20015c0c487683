// A plan made on one rank says what build_mesh() does on as many as there are.

#include "mortise/mesh/mesh_plan.hpp"

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

const std::vector<std::string> sides{"lower/top", "upper/bottom"};

std::vector<BodyDescription> plane_blocks() {
  auto lower = std::make_shared<BlockMesh>(), upper = std::make_shared<BlockMesh>();
  for (auto* block : {lower.get(), upper.get()}) block->width = block->height = 1.0;
  lower->cells_x = lower->cells_y = 9;
  upper->cells_x = upper->cells_y = 7;
  upper->translation = {0.0, 1.0};
  return {{"lower", {}, lower, CellShape::quadrilateral4}, {"upper", {}, upper, CellShape::triangle6}};
}

std::vector<BodyDescription> bricks() {
  auto lower = std::make_shared<BrickMesh>(), upper = std::make_shared<BrickMesh>();
  for (auto* brick : {lower.get(), upper.get()}) brick->width = brick->depth = brick->height = 1.0;
  lower->cells_x = lower->cells_y = lower->cells_z = 6;
  upper->cells_x = upper->cells_y = upper->cells_z = 4;
  upper->translation = {0.0, 0.0, 1.0};
  return {{"lower", {}, lower, CellShape::hexahedron8}, {"upper", {}, upper, CellShape::tetrahedron4}};
}

TEST(MeshPlan, IsWhatRunsDo) {
  const auto comm = Tpetra::getDefaultComm();
  for (const auto& bodies : {plane_blocks(), bricks()}) {
    const auto mesh = build_mesh(comm, bodies, sides);
    const MeshPlan plan = plan_mesh(bodies, sides, comm->getSize());
    const MeshShare& share = plan.shares[comm->getRank()];
    GlobalOrdinal elements = 0, ghosts = 0;
    for (const Block& block : mesh->blocks) {
      elements += block.owned;
      ghosts += block.size() - block.owned;
      for (LocalOrdinal e = 0; e < block.owned; ++e) EXPECT_EQ(plan.rank_of_element[block.element_ids[e]], comm->getRank());
    }
    EXPECT_EQ(share.elements, elements);
    EXPECT_EQ(share.ghost_elements, ghosts);
    EXPECT_EQ(share.nodes, mesh->owned_count());
    EXPECT_EQ(share.ghost_nodes, mesh->local_count() - mesh->owned_count());
    for (const GlobalOrdinal node : local_ids(*mesh->owned_nodes)) EXPECT_EQ(plan.owner_of_node[node], comm->getRank());

    std::vector<std::set<LocalOrdinal>> around(mesh->local_count());
    for (const Block& block : mesh->blocks)
      for (LocalOrdinal e = 0; e < block.size(); ++e)
        for (int a = 0; a < block.nodes_per_element; ++a) around[block.nodes(e)[a]].insert(block.nodes(e), block.nodes(e) + block.nodes_per_element);
    GlobalOrdinal pairs = 0;
    for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node) pairs += static_cast<GlobalOrdinal>(around[node].size());
    EXPECT_EQ(share.node_pairs, pairs);
  }
}

TEST(MeshPlan, SharesEverythingOutOnce) {
  for (const int ranks : {1, 5, 40}) {
    const MeshPlan plan = plan_mesh(bricks(), sides, ranks);
    ASSERT_EQ(plan.shares.size(), static_cast<std::size_t>(ranks));
    GlobalOrdinal elements = 0, nodes = 0;
    for (int rank = 0; rank < ranks; ++rank) {
      const MeshShare& share = plan.shares[rank];
      elements += share.elements;
      nodes += share.nodes;
      GlobalOrdinal ghosts = 0;
      for (const auto& [owner, count] : share.ghosts_from) {
        EXPECT_NE(owner, rank);
        ghosts += count;
      }
      EXPECT_EQ(ghosts, share.ghost_nodes);
    }
    EXPECT_EQ(elements, 6 * 6 * 6 + 6 * 4 * 4 * 4);
    EXPECT_EQ(nodes, 7 * 7 * 7 + 5 * 5 * 5);
    EXPECT_EQ(static_cast<std::size_t>(elements), plan.rank_of_element.size());
  }
}

// Two bricks of 12 x 12 x 12 cells on one another: what faces one another is on one rank but along the cuts through the interface. A cut that is
// straight parts a row of pairs on each side at most, 2 x 12 of 144; two of them quarter the interface. Without regard to contact any 1 - 1 / ranks
// would be.
TEST(MeshPlan, KeepsTogetherWhatFacesOneAnother) {
  auto lower = std::make_shared<BrickMesh>(), upper = std::make_shared<BrickMesh>();
  for (auto* brick : {lower.get(), upper.get()}) {
    brick->width = brick->depth = brick->height = 1.0;
    brick->cells_x = brick->cells_y = brick->cells_z = 12;
  }
  upper->translation = {0.0, 0.0, 1.0};
  const std::vector<BodyDescription> bodies{{"lower", {}, lower, CellShape::hexahedron8}, {"upper", {}, upper, CellShape::hexahedron8}};
  const auto mesh = build_mesh(rcp(new Teuchos::SerialComm<int>()), bodies, sides);
  const auto elements_by_place = [&](const std::string& side) {
    std::map<std::pair<long, long>, GlobalOrdinal> elements;
    for (const Side& one : mesh->side_sets.at(side).sides) {
      const Block& block = mesh->blocks[one.block];
      double x = 0.0, y = 0.0;
      for (int a = 0; a < block.nodes_per_element; ++a) {
        x += mesh->coordinates[block.nodes(one.element)[a]][0] / block.nodes_per_element;
        y += mesh->coordinates[block.nodes(one.element)[a]][1] / block.nodes_per_element;
      }
      elements[{std::lround(24.0 * x), std::lround(24.0 * y)}] = block.element_ids[one.element];
    }
    return elements;
  };
  const auto below = elements_by_place("lower/top"), above = elements_by_place("upper/bottom");
  ASSERT_EQ(below.size(), 144u);
  for (const auto& [ranks, most] : std::vector<std::pair<int, int>>{{2, 24}, {4, 48}}) {
    const MeshPlan plan = plan_mesh(bodies, sides, ranks);
    int parted = 0;
    for (const auto& [place, element] : below) parted += plan.rank_of_element[element] != plan.rank_of_element[above.at(place)];
    EXPECT_LE(parted, most) << ranks << " ranks";
  }
}

}  // namespace
}  // namespace mortise
