// Distributed meshes: areas, sides, ownership, ghosts, balance, sets, errors.

#include "mortise/mesh/build_mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Map.hpp>
#include <cmath>
#include <set>

#include "mortise/mesh/generators.hpp"
#include "mortise/mesh/sets.hpp"

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

double smallest_angle(const Mesh& mesh) {
  double mine = 180.0, all = 0.0;
  for (const Block& block : mesh.blocks)
    for (LocalOrdinal e = 0; e < block.owned; ++e)
      for (int a = 0; a < block.nodes_per_element; ++a) {
        const int n = block.nodes_per_element;
        const auto& p = mesh.coordinates[block.nodes(e)[a]];
        const auto& q = mesh.coordinates[block.nodes(e)[(a + 1) % n]];
        const auto& r = mesh.coordinates[block.nodes(e)[(a + n - 1) % n]];
        const double ux = q[0] - p[0], uy = q[1] - p[1], vx = r[0] - p[0], vy = r[1] - p[1];
        mine = std::min(mine, std::atan2(ux * vy - uy * vx, ux * vx + uy * vy) * 180.0 / std::acos(-1.0));
      }
  Teuchos::reduceAll(*mesh.comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all;
}

std::shared_ptr<BlockMesh> block(double width, double height, int nx, int ny) {
  auto result = std::make_shared<BlockMesh>();
  result->width = width;
  result->height = height;
  result->cells_x = nx;
  result->cells_y = ny;
  return result;
}

std::shared_ptr<QuarterDiskMesh> quarter_disk(int cells) {
  auto result = std::make_shared<QuarterDiskMesh>();
  result->radius = 2.0;
  result->cells_along = cells;
  result->cells_across = cells;
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

TEST(BuildMesh, PositionsDoNotDependOnTheNumberOfRanks) {
  const auto world = Tpetra::getDefaultComm();
  const std::vector<BodyDescription> bodies = {{"disk", {}, quarter_disk(4), CellShape::quadrilateral4}};
  const auto mesh = build_mesh(world, bodies, {"disk/arc"});
  const auto whole = build_mesh(rcp(new Teuchos::SerialComm<int>()), bodies, {"disk/arc"});
  for (LocalOrdinal node = 0; node < mesh->local_count(); ++node) {
    const LocalOrdinal there = whole->local_nodes->getLocalElement(mesh->local_nodes->getGlobalElement(node));
    ASSERT_GE(there, 0);
    EXPECT_EQ(mesh->coordinates[node], whole->coordinates[there]);
  }
}

TEST(BuildMesh, DiskHasItsAreaToSecondOrderAndNoDegeneratePoint) {
  const auto comm = Tpetra::getDefaultComm();
  double last = 0.0;
  for (const int cells : {4, 8, 16}) {
    const auto mesh = build_mesh(comm, {{"disk", {}, quarter_disk(cells), CellShape::quadrilateral4}}, {});
    const double error = std::abs(area(*mesh) - std::acos(-1.0));
    EXPECT_GT(smallest_angle(*mesh), 20.0);
    if (last > 0.0) EXPECT_NEAR(std::log2(last / error), 2.0, 0.1);
    last = error;
    EXPECT_NEAR(length(*mesh, "disk/axis"), 2.0, 1e-12);
    EXPECT_NEAR(length(*mesh, "disk/diameter"), 2.0, 1e-12);
  }
}

TEST(BuildMesh, BalancesTheContactSurface) {
  const auto comm = Tpetra::getDefaultComm();
  const auto mesh = build_mesh(comm, {{"body", {}, block(4.0, 2.0, 60, 30), CellShape::quadrilateral4}}, {"body/top"});
  const auto most = [&](double mine) {
    double all = 0.0;
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
    return all;
  };
  EXPECT_LE(most(mesh->blocks[0].owned), 1.1 * 1800.0 / comm->getSize());
  EXPECT_LE(most(mesh->side_sets.at("body/top").owned), 1.3 * 60.0 / comm->getSize());
}

TEST(Sets, AreMadeFromPositionsAndMissingOnesAreNamed) {
  const auto comm = Tpetra::getDefaultComm();
  const auto mesh = build_mesh(comm, {{"body", {}, block(4.0, 2.0, 4, 2), CellShape::quadrilateral4}}, {});
  add_set(*mesh, {"half", {}, {{"body/top", {}}, Expression("x - 2", {}), SetKind::sides}});
  EXPECT_NEAR(length(*mesh, "half"), 2.0, 1e-12);
  const auto message = [&](const auto& call) -> std::string {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const Place place{"scene.xml", 7, "sets/none"};
  EXPECT_THAT(message([&] { add_set(*mesh, {"none", place, {{"body/top", place}, Expression("x - 9", {}), SetKind::sides}}); }), ::testing::HasSubstr("scene.xml:7: error"));
  EXPECT_THAT(message([&] { require_side_set(*mesh, {"body/tpo", place}); }), ::testing::HasSubstr("body/top"));

  // Each facet of the surface stands on one rank as a master's, and wherever a node of it is owned as a slave's.
  const SideSet& top = mesh->side_sets.at("body/top");
  EXPECT_EQ(sum(*mesh, static_cast<double>(facets_of_owned_elements(*mesh, top).size())), 4.0);
  for (const auto& facet : facets_at_owned_nodes(*mesh, top))
    EXPECT_TRUE(mesh->owned_nodes->isNodeGlobalElement(facet[0]) || mesh->owned_nodes->isNodeGlobalElement(facet[1]));
}

TEST(BuildMesh, RefusesInvertedElements) {
  auto twisted = std::make_shared<BlockMesh>();
  twisted->corners = {0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0};  // two corners exchanged
  twisted->cells_x = twisted->cells_y = 2;
  EXPECT_THROW(build_mesh(Tpetra::getDefaultComm(), {{"body", {"scene.xml", 5, "bodies/body"}, twisted, CellShape::quadrilateral4}}, {}), InputError);
}

}  // namespace
}  // namespace mortise
