// Revolved bodies whose profile reaches the axis: volumes, surfaces and sets, the same on any number of ranks.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <cmath>

#include "mesh_test_support.hpp"
#include "mortise/mesh/build_mesh.hpp"
#include "mortise/mesh/file_body.hpp"
#include "mortise/mesh/volume_generators.hpp"

namespace mortise {
namespace {

RCP<Mesh> revolved(const std::shared_ptr<PlaneMesh>& profile, double angle, int around, CellShape cell) {
  const auto options = std::make_shared<RevolvedMesh>();
  options->profile.options = profile;
  options->angle = angle;
  options->cells_around = around;
  const auto comm = Tpetra::getDefaultComm();
  FileBodyRequest request;
  request.name = "body";
  auto made = options->listed(cell, {});
  if (!made) throw std::logic_error("the profile does not reach the axis");
  if (comm->getRank() == 0) request.made = std::make_shared<const MeshFile>(*std::move(made));
  return build_mesh(comm, {{"body", {}, options, cell, make_file_bodies(*comm, {request}).front()}}, {});
}

std::shared_ptr<BlockMesh> block(double width, double height, int cells) {
  auto result = std::make_shared<BlockMesh>();
  result->width = width, result->height = height;
  result->cells_x = cells, result->cells_y = 2;
  return result;
}

double sum(const Mesh& mesh, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

double volume(const Mesh& mesh) {
  double mine = 0.0;
  for (const Block& block : mesh.blocks)
    visit_cell(block.shape, [&](auto cell) {
      using Cell = decltype(cell);
      if constexpr (Cell::dimension == 3)
        for (LocalOrdinal e = 0; e < block.owned; ++e)
          for (const CellPoint& point : Cell::rule(Cell::stiffness_points)) {
            const auto gradients = Cell::gradients(point.template position<3>());
            Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
            for (int a = 0; a < Cell::nodes; ++a)
              for (int i = 0; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                  jacobian(i, k) += mesh.coordinates[static_cast<std::size_t>(block.nodes(e)[a])][static_cast<std::size_t>(i)] * gradients[a][k];
            EXPECT_GT(jacobian.determinant(), 0.0);
            mine += point.weight * jacobian.determinant();
          }
    });
  return sum(mesh, mine);
}

GlobalOrdinal sides(const Mesh& mesh, const std::string& name) { return static_cast<GlobalOrdinal>(sum(mesh, mesh.side_sets.at(name).owned)); }

TEST(CollapsedSweep, FillsACylinderOfPolygons) {
  // Over a polygon of chords of 15 degrees: radius 2, height 3.
  const double exact = 6 * 0.5 * 4.0 * std::sin(M_PI / 12.0) * 3.0;
  for (const CellShape cell : {CellShape::hexahedron8, CellShape::wedge6, CellShape::tetrahedron4}) {
    const auto mesh = revolved(block(2.0, 3.0, 4), 90.0, 6, cell);
    EXPECT_NEAR(volume(*mesh), exact, 1e-12 * exact) << topology(cell).nodes;
    EXPECT_EQ(mesh->side_sets.count("body/left"), 0u);  // it lies on the axis
    const GlobalOrdinal factor = cell == CellShape::hexahedron8 ? 1 : 2;
    EXPECT_EQ(sides(*mesh, "body/right"), 12 * (cell == CellShape::tetrahedron4 ? 2 : 1));
    EXPECT_EQ(sides(*mesh, "body/start"), 8 * factor);
    EXPECT_EQ(sides(*mesh, "body/end"), 8 * factor);
  }
}

TEST(CollapsedSweep, QuadraticCellsConvergeWithTheFourthOrder) {
  const double exact = M_PI * 3.0;
  double last = 0.0;
  for (const int around : {3, 6}) {
    const auto mesh = revolved(block(2.0, 3.0, 2), 90.0, around, CellShape::hexahedron20);
    ASSERT_EQ(mesh->blocks.size(), 2u);
    const double error = std::abs(volume(*mesh) - exact);
    if (last > 0.0) EXPECT_NEAR(std::log2(last / error), 4.0, 0.2);
    last = error;
  }
  const auto tetrahedra = revolved(block(2.0, 3.0, 2), 90.0, 6, CellShape::tetrahedron10);
  EXPECT_NEAR(volume(*tetrahedra), exact, 2e-3 * exact);
}

TEST(CollapsedSweep, HasOneNodeOnTheAxisForAllLayers) {
  const auto mesh = revolved(block(2.0, 3.0, 4), 90.0, 6, CellShape::hexahedron8);
  double mine = 0.0;
  for (LocalOrdinal node = 0; node < mesh->owned_count(); ++node) {
    const auto& x = mesh->coordinates[static_cast<std::size_t>(node)];
    if (std::hypot(x[0], x[2]) < 1e-12) mine += 1.0;
  }
  EXPECT_EQ(sum(*mesh, mine), 3.0);
  EXPECT_EQ(static_cast<GlobalOrdinal>(mesh->owned_nodes->getGlobalNumElements()), 3 + 3 * 4 * 7);
}

TEST(CollapsedSweep, RefusesCornersOnTheAxisAndWhatIsBeyond) {
  auto tip = block(2.0, 3.0, 1);
  tip->cells_y = 1;
  tip->corners = {0.0, 0.0, 2.0, 0.0, 2.0, 3.0, 1.0, 3.0};  // one corner on the axis
  EXPECT_THAT(input_error_of([&] { revolved(tip, 90.0, 4, CellShape::hexahedron8); }), ::testing::HasSubstr("meets the axis with one node"));
  auto beyond = block(2.0, 3.0, 2);
  beyond->translation = {-0.5, 0.0};
  EXPECT_THAT(input_error_of([&] { revolved(beyond, 90.0, 4, CellShape::hexahedron8); }), ::testing::HasSubstr("allowed: x >= 0"));
}

}  // namespace
}  // namespace mortise
