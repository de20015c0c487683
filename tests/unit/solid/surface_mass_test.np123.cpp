// Mass of contact surfaces and of rigid bodies: totals, weights, moments, on several ranks.

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/volume_generators.hpp"
#include "mortise/solid/massless_nodes.hpp"
#include "mortise/solid/nodal_mass.hpp"
#include "mortise/solid/rigid_mass.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

constexpr double density = 2.0;  // of make_material

/// 2 x 1 x 3 with a corner at (0.5, -1, 0.25).
std::shared_ptr<Bodies> make_box(CellShape shape = CellShape::hexahedron8, int cells = 0) {
  const auto brick = std::make_shared<BrickMesh>();
  brick->width = 2.0;
  brick->depth = 1.0;
  brick->height = 3.0;
  brick->cells_x = 4;
  brick->cells_y = 3;
  brick->cells_z = 5;
  if (cells > 0) brick->cells_x = brick->cells_y = brick->cells_z = cells;
  brick->translation = {0.5, -1.0, 0.25};
  BodyDescription body;
  body.name = "box";
  body.mesh = brick;
  body.shape = shape;
  const RCP<const Mesh> mesh = build_mesh(Tpetra::getDefaultComm(), {body}, {});
  return std::make_shared<Bodies>(
      displacement_space(mesh), Kinematics::three_dimensional, 1.0,
      std::vector<BodyProperties>{{"box", {}, make_material("hencky"), shape == CellShape::hexahedron8 ? ElementType::h8 : ElementType::tet10}});
}

double over_ranks(const Mesh& mesh, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

TEST(MasslessNodes, TakeTheVelocityOfTheNodeBelow) {
  const auto bodies = make_box();
  const Mesh& mesh = *bodies->mesh();
  const MasslessNodes massless = massless_nodes(mesh, {{"box/top", {}}}, {false});
  EXPECT_EQ(over_ranks(mesh, static_cast<double>(massless.nodes.size())), 5.0 * 4.0);
  EXPECT_TRUE(massless.kept.empty());
  const auto P = massless.extension->getLocalMatrixHost();
  for (const LocalOrdinal node : massless.nodes) {
    ASSERT_EQ(P.graph.row_map(node + 1) - P.graph.row_map(node), 1u);
    const std::size_t k = P.graph.row_map(node);
    EXPECT_NEAR(P.values(k), 1.0, 1e-14);
    const LocalOrdinal below = mesh.local_nodes->getLocalElement(massless.extension->getColMap()->getGlobalElement(P.graph.entries(k)));
    EXPECT_NEAR(mesh.coordinates[below][0], mesh.coordinates[node][0], 1e-14);
    EXPECT_NEAR(mesh.coordinates[below][2], mesh.coordinates[node][2] - 0.6, 1e-14);
  }
}

// All sides at once: what is left are the interior nodes.
TEST(MasslessNodes, KeepTheTotalMassAndNoMassOfTheirOwn) {
  const auto bodies = make_box();
  const Mesh& mesh = *bodies->mesh();
  const MasslessNodes massless = massless_nodes(mesh, {{"box/surface", {}}}, {false});
  EXPECT_TRUE(massless.kept.empty());
  const RCP<const Matrix> mass = mass_of_extension(*consistent_mass(*bodies), *massless.extension);
  Vector ones(mesh.owned_nodes), sums(mesh.owned_nodes);
  ones.putScalar(1.0);
  mass->apply(ones, sums);
  EXPECT_NEAR(ones.dot(sums), density * 6.0, 1e-12);
  const auto rows = sums.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (const LocalOrdinal node : massless.nodes) EXPECT_EQ(rows(node, 0), 0.0);
  const auto P = massless.extension->getLocalMatrixHost();
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    double sum = 0.0;
    for (std::size_t k = P.graph.row_map(node); k < P.graph.row_map(node + 1); ++k) {
      EXPECT_GE(P.values(k), 0.0);
      sum += P.values(k);
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
  }
}

TEST(MasslessNodes, OfBodiesThatKeepTheirMassAreNone) {
  const auto bodies = make_box();
  EXPECT_TRUE(massless_nodes(*bodies->mesh(), {{"box/top", {}}}, {true}).nodes.empty());
}

TEST(RigidMass, WithinASurfaceIsThatOfTheBox) {
  const auto bodies = make_box();
  const RigidMass mass = mass_within(*bodies, {"box/surface", {}}, 0.5);
  EXPECT_NEAR(mass.mass, 3.0, 1e-13);
  const Eigen::Vector3d size(2.0, 1.0, 3.0), centre(1.5, -0.5, 1.75);
  EXPECT_LE((mass.centre - centre).norm(), 1e-13);
  const Eigen::Matrix3d expected = (3.0 / 12.0 * size.cwiseProduct(size)).asDiagonal();
  EXPECT_LE((mass.second_moments - expected).norm(), 1e-12);
  EXPECT_THROW(mass_within(*bodies, {"box/top", {}}, 0.5), InputError);
}

// Nodes of tetrahedra have many neighbours.
TEST(MasslessNodes, OfTetrahedra) {
  const auto bodies = make_box(CellShape::tetrahedron10);
  const Mesh& mesh = *bodies->mesh();
  const MasslessNodes massless = massless_nodes(mesh, {{"box/top", {}}}, {false});
  Vector ones(mesh.owned_nodes), sums(mesh.owned_nodes);
  ones.putScalar(1.0);
  massless.extension->apply(ones, sums);
  sums.update(-1.0, ones, 1.0);
  EXPECT_LE(sums.normInf(), 1e-14);
  EXPECT_EQ(over_ranks(mesh, static_cast<double>(massless.nodes.size())), 9.0 * 7.0);
}

/// Down to the corners of one cell.
class MassOfABox : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Cells, MassOfABox, ::testing::Values(1, 2, 3));

TEST_P(MassOfABox, IsThatOfTheBody) {
  const auto bodies = make_box(CellShape::hexahedron8, GetParam());
  const Mesh& mesh = *bodies->mesh();
  std::vector<LocalOrdinal> nodes;
  for (const LocalOrdinal node : mesh.node_sets.at("box/surface"))
    if (node < mesh.owned_count()) nodes.push_back(node);
  const RigidMass wanted = rigid_mass(1.7, {1.2, -0.4, 2.0}, {0.5, 0.8, 0.9});
  const auto block = mass_on_nodes(mesh, nodes, wanted);
  ASSERT_TRUE(block);
  EXPECT_EQ(block->nodes.size(), 4u);
  EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(block->mass).eigenvalues().minCoeff(), -1e-12);
  double mass = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  MassRows rows(static_cast<std::size_t>(mesh.owned_count()));
  add_block(mesh, *block, rows);
  std::map<GlobalOrdinal, Eigen::Vector3d> arms;  // of all nodes of the block, on each rank
  for (const GlobalOrdinal id : block->nodes) {
    const LocalOrdinal node = mesh.owned_nodes->getLocalElement(id);
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();
    if (node >= 0) arm = Eigen::Map<const Eigen::Vector3d>(mesh.coordinates[node].data()) - wanted.centre;
    for (int i = 0; i < 3; ++i) arms[id][i] = over_ranks(mesh, arm[i]);
  }
  for (std::size_t node = 0; node < rows.size(); ++node)
    for (const auto& [other, value] : rows[node]) {
      const Eigen::Vector3d &arm = arms.at(mesh.owned_nodes->getGlobalElement(static_cast<LocalOrdinal>(node))), &of_other = arms.at(other);
      mass += value;
      first += value * arm;
      second += value * arm * of_other.transpose();
    }
  EXPECT_NEAR(over_ranks(mesh, mass), 1.7, 1e-12);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(over_ranks(mesh, first[i]), 0.0, 1e-12);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(over_ranks(mesh, second(i, k)), wanted.second_moments(i, k), 1e-12);
  }
  EXPECT_NEAR(wanted.second_moments.trace(), 1.1, 1e-15);
}

TEST(RigidMass, NodesInAPlaneCarryNoMomentAcross) {
  const auto bodies = make_box();
  const Mesh& mesh = *bodies->mesh();
  std::vector<LocalOrdinal> nodes;
  for (const LocalOrdinal node : mesh.node_sets.at("box/top"))
    if (node < mesh.owned_count()) nodes.push_back(node);
  EXPECT_FALSE(mass_on_nodes(mesh, nodes, rigid_mass(1.0, {1.5, -0.5, 3.25}, {0.5, 0.8, 0.9})));
}

}  // namespace
}  // namespace mortise
