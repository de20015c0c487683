// METIS' partition of two bodies in contact: balance of elements, of contact elements and of nodes; the same every time.

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

/// Largest over mean of a number that each rank has.
double imbalance(const Communicator& comm, double mine) {
  double most = 0.0, sum = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &mine, &most);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 1, &mine, &sum);
  return most * comm.getSize() / sum;
}

/// Two blocks on each other, 40 x 20 each, with interfaces that do not match.
RCP<Mesh> patch(CellShape cell) {
  auto lower = std::make_shared<BlockMesh>(), upper = std::make_shared<BlockMesh>();
  for (auto* block : {lower.get(), upper.get()}) {
    block->width = 40.0;
    block->height = 20.0;
    block->cells_y = 15;
  }
  lower->cells_x = 35;
  upper->cells_x = 25;
  upper->translation = {0.0, 20.0};
  return build_mesh(Tpetra::getDefaultComm(), {{"lower", {}, lower, cell}, {"upper", {}, upper, cell}}, {"lower/top", "upper/bottom"});
}

TEST(Partition, BalancesElementsContactElementsAndNodes) {
  for (const auto cell : {CellShape::quadrilateral4, CellShape::triangle3}) {
    const auto mesh = patch(cell);
    double elements = 0.0;
    for (const auto& block : mesh->blocks) elements += block.owned;
    const double contact = mesh->side_sets.at("lower/top").owned + mesh->side_sets.at("upper/bottom").owned;
    EXPECT_LE(imbalance(*mesh->comm, contact), 1.3);
    EXPECT_LE(imbalance(*mesh->comm, elements), 1.3);
    EXPECT_LE(imbalance(*mesh->comm, static_cast<double>(mesh->owned_count())), 1.3);
  }
}

TEST(Partition, BalancesBodiesOfSpace) {
  auto lower = std::make_shared<BrickMesh>(), upper = std::make_shared<BrickMesh>();
  for (auto* brick : {lower.get(), upper.get()}) {
    brick->width = brick->depth = 4.0;
    brick->height = 2.0;
    brick->cells_z = 6;
  }
  lower->cells_x = lower->cells_y = 12;
  upper->cells_x = upper->cells_y = 8;
  upper->translation = {0.0, 0.0, 2.0};
  for (const auto cell : {CellShape::hexahedron8, CellShape::tetrahedron10}) {
    const auto mesh = build_mesh(Tpetra::getDefaultComm(), {{"lower", {}, lower, CellShape::hexahedron8}, {"upper", {}, upper, cell}},
                                 {"lower/top", "upper/bottom"});
    double elements = 0.0;
    for (const auto& block : mesh->blocks) elements += block.owned;
    const double contact = mesh->side_sets.at("lower/top").owned + mesh->side_sets.at("upper/bottom").owned;
    EXPECT_LE(imbalance(*mesh->comm, contact), 1.3);
    EXPECT_LE(imbalance(*mesh->comm, elements), 1.3);
    EXPECT_LE(imbalance(*mesh->comm, static_cast<double>(mesh->owned_count())), 1.3);
    // Few nodes stand on several ranks: a cut through the whole has one node in so many as there are along its shorter way.
    const double ghosts = mesh->local_count() - mesh->owned_count();
    EXPECT_LT(ghosts, mesh->owned_count());
  }
}

TEST(Partition, IsTheSameEveryTime) {
  const auto first = patch(CellShape::quadrilateral4), second = patch(CellShape::quadrilateral4);
  EXPECT_TRUE(first->local_nodes->isSameAs(*second->local_nodes));
  for (std::size_t b = 0; b < first->blocks.size(); ++b) {
    EXPECT_EQ(first->blocks[b].element_ids, second->blocks[b].element_ids);
    EXPECT_EQ(first->blocks[b].connectivity, second->blocks[b].connectivity);
  }
}

}  // namespace
}  // namespace mortise
