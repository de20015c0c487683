// Rows that hold bodies against the forces of contact itself.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "formulations.hpp"
#include "mortise/contact/holding_nodes.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;

const Eigen::Vector3d pole[2] = {{0.4, 0.7, -0.1}, {-0.3, 0.2, 0.5}};  // that moments are taken about

TwoSurfaces with_friction(TwoSurfaces surfaces, const std::shared_ptr<Formulation>& formulation) {
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  surfaces.options.friction.options = coulomb;
  if (formulation) surfaces.options.formulation.options = formulation;
  return surfaces;
}

Eigen::Vector3d position(const TwoSurfaces& surfaces, GlobalOrdinal node) {
  const auto slaves = static_cast<GlobalOrdinal>(surfaces.slave.size());
  const test::Point& x = node < slaves ? surfaces.slave[static_cast<std::size_t>(node)] : surfaces.master[static_cast<std::size_t>(node - slaves)];
  return {x[0], x[1], surfaces.dimension == 2 ? 0.0 : x[2]};
}

using Wrenches = Eigen::Matrix<double, 6, 2>;  // of both bodies

Wrenches of_row(const HoldingRow& row) {
  Wrenches result = Wrenches::Zero();
  for (const auto& wrench : row.bodies) result.col(wrench.body) << Eigen::Vector3d(wrench.force.data()), Eigen::Vector3d(wrench.moment.data());
  return result;
}

/// Of the contact force of z, over all ranks.
Wrenches of_force(const Fixture& fixture, const TwoSurfaces& surfaces, const ContactEvaluation& at, const Vector& z) {
  const int dim = surfaces.dimension;
  Vector force(fixture.dofs);
  at.add_force(z, force);
  const auto values = force.getLocalViewHost(Tpetra::Access::ReadOnly);
  Wrenches mine = Wrenches::Zero(), all = mine;
  for (std::size_t n = 0; n < local_id_count(*fixture.nodes); ++n) {
    const GlobalOrdinal node = fixture.nodes->getGlobalElement(static_cast<LocalOrdinal>(n));
    const int body = node < static_cast<GlobalOrdinal>(surfaces.slave.size()) ? 0 : 1;
    Eigen::Vector3d f = Eigen::Vector3d::Zero();
    for (int i = 0; i < dim; ++i) f[i] = values(dim * n + i, 0);
    mine.col(body).head<3>() += f;
    Eigen::Vector3d arm = position(surfaces, node) - pole[body];
    if (dim == 2) arm.z() = 0.0;
    mine.col(body).tail<3>() += arm.cross(f);
  }
  Teuchos::reduceAll(*fixture.nodes->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

/// The slave is body 0, the master body 1.
MultiVector places_in(const Fixture& fixture, const TwoSurfaces& surfaces) {
  MultiVector places(fixture.nodes, static_cast<std::size_t>(1 + surfaces.dimension));
  for (std::size_t n = 0; n < local_id_count(*fixture.nodes); ++n) {
    const GlobalOrdinal node = fixture.nodes->getGlobalElement(static_cast<LocalOrdinal>(n));
    const int body = node < static_cast<GlobalOrdinal>(surfaces.slave.size()) ? 0 : 1;
    places.replaceLocalValue(n, 0, body);
    for (int i = 0; i < surfaces.dimension; ++i) places.replaceLocalValue(n, 1 + i, position(surfaces, node)[i] - pole[body][i]);
  }
  return places;
}

/// All nodes that are covered closed; nothing has slipped, so they stick.
void compare(const TwoSurfaces& surfaces) {
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const int dim = surfaces.dimension;
  Vector d(fixture.dofs), none(contact.multiplier_map());
  const DifferentiatedContact at = contact.differentiate(d, fixture.first_step(d, none));
  const RCP<Vector> z = fixture.multipliers([](std::size_t) { return 1e6; });
  const ContactLaws laws = at.laws(*z);

  const std::vector<HoldingRow> rows = holding_rows(laws, places_in(fixture, surfaces));

  // Rows come node by node.
  std::vector<ContactNodeState> closed;
  int sticking = 0;
  for (const auto& node : node_states(laws, 0)) {
    if (node.closed) closed.push_back(node);
    sticking += node.state == ContactState::stick;
  }
  ASSERT_EQ(rows.size(), closed.size() + static_cast<std::size_t>((dim - 1) * sticking));
  const GlobalOrdinal offset = fixture.dofs->getMaxAllGlobalIndex() + 1;
  const auto comm = fixture.nodes->getComm();
  std::size_t next = 0;
  int compared = 0, most = 0;
  for (int rank = 0; rank < comm->getSize(); ++rank) {  // all help to find the force of one row at a time
    int count = static_cast<int>(rows.size());
    Teuchos::broadcast(*comm, rank, Teuchos::outArg(count));
    most += count;
    for (int r = 0; r < count; ++r) {
      Vector one(contact.multiplier_map());
      const bool mine = rank == comm->getRank();
      if (mine) {
        if (!rows[r].along_surface) ++next;
        const ContactNodeState& node = closed[next - 1];
        // A traction across the normal acts through coefficients alone: the row's force on a body has its direction.
        const Eigen::Vector3d force = of_row(rows[r]).col(0).head<3>();
        const Eigen::Vector3d direction = rows[r].along_surface ? Eigen::Vector3d(force.normalized()) : Eigen::Vector3d(node.normal.data());
        if (rows[r].along_surface) EXPECT_NEAR(direction.dot(Eigen::Vector3d(node.normal.data())), 0.0, 1e-12);
        for (int i = 0; i < dim; ++i) one.replaceGlobalValue(offset + dim * node.node + i, direction[i]);
      }
      const Wrenches expected = of_force(fixture, surfaces, at, one);
      if (!mine) continue;
      const Wrenches found = of_row(rows[r]);
      const double scale = expected.col(0).head<3>().norm() / found.col(0).head<3>().norm();
      EXPECT_LE(std::min((scale * found - expected).norm(), (scale * found + expected).norm()), 1e-11 * expected.norm());
      ++compared;
    }
  }
  EXPECT_EQ(compared, static_cast<int>(rows.size()));
  EXPECT_GT(most, dim * 3);
}

TEST(HoldingRows, AreTheForcesOfContactInThePlane) {
  compare(with_friction(test::arch_on_ground(), nullptr));
  for (const auto& formulation : test::other_formulations()) {
    SCOPED_TRACE(formulation.name);
    compare(with_friction(test::arch_on_ground(), formulation.options));
  }
}

TEST(HoldingRows, AreTheForcesOfContactInSpace) {
  compare(with_friction(test::dome_on_waves(), nullptr));
  compare(with_friction(test::quadratic(test::dome_on_waves(), true, true), nullptr));
  for (const auto& formulation : test::other_formulations()) {
    if (!test::in_space(formulation)) continue;
    SCOPED_TRACE(formulation.name);
    compare(with_friction(test::dome_on_waves(), formulation.options));
  }
}

TEST(HoldingRows, OpenNodesHoldNothingAndNodesWithoutABodyAreLeftOut) {
  const TwoSurfaces surfaces = with_friction(test::arch_on_ground(), nullptr);
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  Vector d(fixture.dofs), z(fixture.contact->multiplier_map());
  const DifferentiatedContact at = fixture.contact->differentiate(d, fixture.first_step(d, z));
  MultiVector places(fixture.nodes, 3);
  const auto pulled = fixture.multipliers([](std::size_t) { return -1e6; }), pressed = fixture.multipliers([](std::size_t) { return 1e6; });
  EXPECT_TRUE(holding_rows(at.laws(*pulled), places).empty());
  for (std::size_t n = 0; n < local_id_count(*fixture.nodes); ++n) places.replaceLocalValue(n, 0, -1.0);
  EXPECT_TRUE(holding_rows(at.laws(*pressed), places).empty());
}

// Over a plane no gap changes by a motion along it, whatever the shape of the slave. Forces along its normals, which lean, do work on that motion.
// Nodes that slip hold by what friction bears along the tangent, but not as those that stick.
TEST(HoldingRows, ConditionsHoldNothingAlongAPlane) {
  TwoSurfaces surfaces;
  for (int i = 0; i < 6; ++i) surfaces.slave.push_back({1.0 * i, 0.02 * i * i - 0.003 * i * i * i, 0.0});
  for (int i = 0; i < 4; ++i) surfaces.master.push_back({7.0 - 3.0 * i, 0.0, 0.0});
  surfaces.fixed.assign(surfaces.size(), {});
  for (const bool rubs : {false, true}) {
    SCOPED_TRACE(rubs);
    const TwoSurfaces pair = rubs ? with_friction(surfaces, nullptr) : surfaces;
    Fixture fixture(pair, Tpetra::getDefaultComm());
    Vector d(fixture.dofs), none(fixture.contact->multiplier_map());
    const DifferentiatedContact at = fixture.contact->differentiate(d, fixture.first_step(d, none));
    const RCP<Vector> z = fixture.multipliers([](std::size_t) { return 1e6; });
    for (std::size_t n = 0; n < z->getLocalLength(); n += 2) z->replaceLocalValue(static_cast<LocalOrdinal>(n), 0.6e6);  // twice what friction bears
    const ContactLaws laws = at.laws(*z);
    const MultiVector places = places_in(fixture, pair);
    const auto by_forces = holding_rows(laws, places), by_conditions = holding_rows(laws, places, Holds::by_conditions);
    int mine[2] = {static_cast<int>(by_forces.size()), static_cast<int>(by_conditions.size())}, all[2];
    Teuchos::reduceAll(*fixture.nodes->getComm(), Teuchos::REDUCE_SUM, 2, mine, all);
    EXPECT_EQ(all[0], 6);
    EXPECT_EQ(all[1], rubs ? 12 : 6);
    double leans = 0.0, most = 0.0;
    for (const HoldingRow& row : by_forces) leans = std::max(leans, std::abs(of_row(row)(0, 0)));
    for (const HoldingRow& row : by_conditions) {
      const Wrenches wrenches = of_row(row);
      if (row.along_surface) continue;
      EXPECT_LE(wrenches.row(0).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_NEAR(wrenches(1, 0) + wrenches(1, 1), 0.0, 1e-12);
      EXPECT_GT(std::abs(wrenches(1, 0)), 0.1);
    }
    Teuchos::reduceAll(*fixture.nodes->getComm(), Teuchos::REDUCE_MAX, leans, Teuchos::outArg(most));
    EXPECT_GT(most, 0.01);
  }
}

/// The slave is moved as a whole, by so little that what is coupled stays the same; its shear is more than friction bears.
void compare_sliding(const TwoSurfaces& surfaces) {
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const auto comm = fixture.nodes->getComm();
  const int dim = surfaces.dimension;
  const auto slaves = static_cast<GlobalOrdinal>(surfaces.slave.size());
  const double distance = 1e-7;
  const Eigen::Vector3d motion = distance * (dim == 2 ? Eigen::Vector3d(1.0, 0.0, 0.0) : Eigen::Vector3d(0.8, -0.6, 0.0));
  Vector d(fixture.dofs), none(contact.multiplier_map());
  const ContactHistory history = fixture.first_step(d, none);
  for (std::size_t n = 0; n < local_id_count(*fixture.nodes); ++n)
    for (int i = 0; i < dim; ++i)
      if (fixture.nodes->getGlobalElement(static_cast<LocalOrdinal>(n)) < slaves) d.replaceLocalValue(dim * n + i, motion[i]);
  const DifferentiatedContact at = contact.differentiate(d, history);
  const RCP<Vector> z = fixture.multipliers([](std::size_t) { return 1e6; });                                           // closes what is covered
  for (std::size_t n = 0; n < z->getLocalLength(); n += static_cast<std::size_t>(dim)) z->replaceLocalValue(n, 0.6e6);  // twice what friction bears

  const ContactLaws laws = at.laws(*z);
  const std::vector<SlidingNode> nodes = sliding_nodes(laws, places_in(fixture, surfaces));
  int slipping = 0, most = 0;
  for (const auto& node : node_states(laws, 0)) slipping += node.state == ContactState::slip;
  ASSERT_EQ(static_cast<int>(nodes.size()), slipping);
  for (int rank = 0; rank < comm->getSize(); ++rank) {
    int count = static_cast<int>(nodes.size()) * (dim - 1);
    Teuchos::broadcast(*comm, rank, Teuchos::outArg(count));
    most += count;
    for (int k = 0; k < count; ++k) {
      const bool mine = rank == comm->getRank();
      const std::size_t a = static_cast<std::size_t>(k % (dim - 1));
      Vector one(contact.multiplier_map());
      if (mine) {
        const SlidingNode& node = nodes[static_cast<std::size_t>(k / (dim - 1))];
        for (int i = 0; i < dim; ++i) one.replaceLocalValue(node.multiplier + i, node.tangents[a][static_cast<std::size_t>(i)]);
      }
      const Wrenches expected = of_force(fixture, surfaces, at, one);
      if (!mine) continue;
      const SlidingNode& node = nodes[static_cast<std::size_t>(k / (dim - 1))];
      HoldingRow row;
      row.bodies = node.along[a];
      const Wrenches found = of_row(row);
      EXPECT_LE(std::min((found - expected).norm(), (found + expected).norm()), 1e-11 * expected.norm());
      // Where the surfaces stand apart, a slip also sees the normal turn: gap over radius.
      EXPECT_NEAR(std::abs(node.slip[a]), std::abs(found.col(0).head<3>().dot(motion)), 1e-2 * distance * node.weight);
      EXPECT_GT(node.bound, 0.0);
    }
  }
  EXPECT_GT(most, 3 * (dim - 1));
}

TEST(SlidingNodes, BearTheForcesOfContactAndSlipAsTheirBodiesMove) {
  compare_sliding(with_friction(test::arch_on_ground(), nullptr));
  compare_sliding(with_friction(test::dome_on_waves(), nullptr));
}

}  // namespace
}  // namespace mortise
