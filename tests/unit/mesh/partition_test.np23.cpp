// METIS' partition of two bodies in contact: balance of elements, of contact elements and of nodes; the same every time.

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/generators.hpp"

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
