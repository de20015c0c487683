// Nodes with prescribed components: normals at supports and at planes of symmetry, friction along what is prescribed.

#include <gtest/gtest.h>

#include <map>

#include "mortise/contact/complementarity.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::Point;
using test::TwoSurfaces;

constexpr double lean = 0.2;  // radians

/// Slave nodes along a curve from the origin on, node 0 held in x, on master nodes along another one, which begins before it.
TwoSurfaces held_at_its_end(const std::function<Point(double)>& slave, const std::function<Point(double)>& master) {
  TwoSurfaces surfaces;
  for (int i = 0; i < 6; ++i) surfaces.slave.push_back(slave(i));
  for (int i = 0; i < 9; ++i) surfaces.master.push_back(master(6.3 - i));
  surfaces.fixed.assign(surfaces.size(), {});
  surfaces.fixed[0] = {true, false, false};
  return surfaces;
}

Point on_slope(double s) { return {s * std::cos(lean), s * std::sin(lean), 0.0}; }
Point on_level(double s) { return {s, 0.0, 0.0}; }
/// A circle that facets of length 1 turn along by the lean.
Point on_circle(double s) { return {std::sin(lean * s) / lean, (1.0 - std::cos(lean * s)) / lean, 0.0}; }

/// The normal of the held node.
std::array<double, 2> normal_of_end(TwoSurfaces surfaces) {
  surfaces.options.mortar.search_reach = 2.0;
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  Vector none(fixture.dofs), z(fixture.contact->multiplier_map());
  const ContactHistory history = fixture.contact->initial_history(none);
  std::array<double, 2> mine{}, all{};
  for (const auto& state : node_states(fixture.contact->evaluate(none, history).laws(z), 0))
    if (state.node == 0) mine = {state.normal[0], state.normal[1]};
  Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_SUM, 2, mine.data(), all.data());
  return all;
}

TEST(HeldNode, KeepsItsLeanAtASupport) {
  const auto normal = normal_of_end(held_at_its_end(on_slope, on_slope));
  EXPECT_NEAR(normal[0], std::sin(lean), 1e-14);
  EXPECT_NEAR(normal[1], -std::cos(lean), 1e-14);
}

TEST(HeldNode, HasNoneOnASmoothSurfaceThatALineOfSymmetryCuts) {
  for (const auto& master : {on_circle, on_level}) {
    const auto normal = normal_of_end(held_at_its_end(on_circle, master));
    EXPECT_EQ(normal[0], 0.0);
    EXPECT_NEAR(normal[1], -1.0, 1e-14);
  }
}

TEST(HeldNode, HasNoneAtTheTipOfAWedgeOnAFlatFace) {
  const auto normal = normal_of_end(held_at_its_end(on_slope, on_level));
  EXPECT_EQ(normal[0], 0.0);
  EXPECT_NEAR(normal[1], -1.0, 1e-14);
}

/// Shear traction at the held node that its law calls for, where pressures are 10.
double shear_of_end(const TwoSurfaces& surfaces, double slave_x, double master_x) {
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  Vector none(fixture.dofs), guess(contact.multiplier_map());
  const ContactHistory history = fixture.first_step(none, guess);
  const auto d = Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) {
    const bool slave = static_cast<std::size_t>(id / 2) < surfaces.slave.size();
    return id % 2 == 1 ? 0.0 : slave ? slave_x : master_x;
  });
  const GlobalOrdinal offset = fixture.dofs->getMaxAllGlobalIndex() + 1;
  const auto z = Fixture::vector(contact.multiplier_map(), [&](GlobalOrdinal id) { return (id - offset) % 2 == 0 ? 0.0 : -10.0; });
  Vector C(contact.multiplier_map());
  contact.evaluate(*d, history).laws(*z).complementarity(C);
  const LocalOrdinal row = C.getMap()->getLocalElement(offset + 1);
  const double mine = row < 0 ? 0.0 : -C.getLocalViewHost(Tpetra::Access::ReadOnly)(row, 0);  // C = z_tau - what the law says, at z_tau = 0
  double all = 0.0;
  Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

// The tangent is +x.
TEST(HeldNode, BearsFrictionAgainstItsSlip) {
  TwoSurfaces surfaces = held_at_its_end(on_level, on_level);
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  surfaces.options.friction.options = coulomb;
  EXPECT_NEAR(shear_of_end(surfaces, 0.1, 0.0), 3.0, 1e-12);
  EXPECT_NEAR(shear_of_end(surfaces, -0.1, 0.0), -3.0, 1e-12);
  EXPECT_NEAR(shear_of_end(surfaces, 0.0, 0.1), -3.0, 1e-12);
  EXPECT_EQ(shear_of_end(surfaces, 0.0, 0.0), 0.0);
}

// A spring at rest, with the traction that it had; Coulomb's law beyond.
TEST(HeldTangents, GoOnFromTheTractionTheyHad) {
  const double c = 7.0, rho = 3.0;
  const Frame plane = make_frame(Eigen::Vector2d(0.0, -1.0), 0), space = make_frame(Eigen::Vector3d(0.0, 0.0, -1.0), 0);
  for (const double compliance : {1.0, 0.01})
    for (const double had : {-2.0, 0.0, 2.5})
      for (const double slip : {-0.8, -0.1, 0.0, 0.05, 0.3}) {
        const double borne = std::clamp(had + c / compliance * slip, -rho, rho);
        const HeldTangents held{1, TangentVector::Constant(1, had), compliance};
        const auto node = with_friction(c, c, 0.0, TangentVector::Constant(1, slip), plane, Eigen::Vector2d(borne, -10.0), {rho, 0.3}, 0.0, held);
        EXPECT_NEAR(node.C[1], 0.0, 1e-14) << had << " " << slip;
        const HeldTangents both{2, TangentVector(Eigen::Vector2d(0.6 * had, 0.8 * had)), compliance};
        const auto in_space = with_friction(c, c, 0.0, TangentVector(slip * Eigen::Vector2d(0.6, 0.8)), space,
                                            SpatialVector(10.0 * space.normal + space.tangents.transpose() * (borne * Eigen::Vector2d(0.6, 0.8))),
                                            {rho, 0.3}, 0.0, both);
        EXPECT_NEAR(in_space.C.tail(2).norm(), 0.0, 1e-14) << had << " " << slip;
      }
}

// Of two tangents, one of them held: a plastic slip takes the direction of the traction, as of a node that is held along none.
TEST(HeldTangents, SlipAlongTheTraction) {
  const double c = 7.0, rho = 3.0, compliance = 0.01, had = 0.4;
  const Frame in = make_frame(Eigen::Vector3d(0.0, 0.0, -1.0), 0);
  for (const double angle : {0.0, 0.5, 1.5, 2.5})
    for (const double plastic : {0.01, 1.0}) {
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), t = rho * along;
      const Eigen::Vector2d slip = plastic * along + Eigen::Vector2d(compliance * (t[0] - had) / c, 0.0);
      const HeldTangents held{1, TangentVector(Eigen::Vector2d(had, 0.0)), compliance};
      const auto law = [&](const SpatialVector& z, const Eigen::Vector2d& u) {
        return with_friction(c, c, 0.0, TangentVector(u), in, z, {0.3 * z.dot(in.normal), 0.3}, 0.0, held);
      };
      const SpatialVector z = 10.0 * in.normal + in.tangents.transpose() * t;
      EXPECT_NEAR(law(z, slip).C.tail(2).norm(), 0.0, 1e-13) << angle;
      const double h = 1e-5;
      const auto at = law(z, slip);
      for (int k = 0; k < 3; ++k) {
        const SpatialVector e = SpatialVector::Unit(3, k);
        const SpatialVector difference = (law(z + h * e, slip).C - law(z - h * e, slip).C) / (2.0 * h);
        EXPECT_NEAR((at.C_z.col(k) - difference).tail(2).norm(), 0.0, 1e-8) << angle;
      }
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector2d e = Eigen::Vector2d::Unit(k);
        const SpatialVector difference = (law(z, slip + h * e).C - law(z, slip - h * e).C) / (2.0 * h);
        EXPECT_NEAR((at.slip_factor.col(k) - difference.tail(2)).norm(), 0.0, 1e-7) << angle;
      }
    }
}

/// Tractions, states, slips and slipped paths of the slave nodes, by node.
std::map<GlobalOrdinal, std::array<double, 5>> memory_of(const ContactSystem& contact, const ContactHistory& history, const Vector& d) {
  std::map<GlobalOrdinal, std::array<double, 5>> result;
  for (const auto& node : node_states(contact.evaluate(d, history).laws(*history->multipliers), 0))
    result[node.node] = {node.traction[0], node.traction[1], node.closed ? 1.0 : 0.0, node.slip, node.slip_path};
  return result;
}

// A host releases a support: it makes a new system, which goes on from where the old one was.
TEST(ReleasedSupport, KeepsWhatOtherNodesHad) {
  TwoSurfaces surfaces = test::arch_on_ground();
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  surfaces.options.friction.options = coulomb;
  TwoSurfaces held = surfaces;
  held.fixed[0] = {true, true, false};
  const Fixture before(held, Tpetra::getDefaultComm()), after(surfaces, Tpetra::getDefaultComm());
  ASSERT_LT(before.contact->multiplier_map()->getGlobalNumElements(), after.contact->multiplier_map()->getGlobalNumElements());
  Vector none(before.dofs), z(before.contact->multiplier_map());
  const ContactHistory start = before.first_step(none, z);
  const auto d = Fixture::vector(before.dofs, [&](GlobalOrdinal id) { return id < 12 ? (id % 2 == 0 ? 0.1 : -0.04) : 0.0; });
  const GlobalOrdinal offset = before.dofs->getMaxAllGlobalIndex() + 1;
  const auto pressed = Fixture::vector(before.contact->multiplier_map(), [&](GlobalOrdinal id) { return (id - offset) % 2 == 0 ? 0.2 : -10.0; });
  const ContactHistory accepted = before.contact->commit(before.contact->evaluate(*d, start).laws(*pressed));
  const ContactHistory carried = after.contact->carry_over(*before.contact, accepted);
  EXPECT_TRUE(carried->multipliers->getMap()->isSameAs(*after.contact->multiplier_map()));
  const auto had = memory_of(*before.contact, accepted, *d), has = memory_of(*after.contact, carried, *d);
  int compared = 0, closed = 0;
  for (const auto& [node, values] : has) {
    if (node == 0) {
      EXPECT_EQ(std::hypot(values[0], values[1]), 0.0) << "had no multiplier";
      continue;
    }
    ++compared;
    closed += values[2] > 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], had.at(node)[k], 1e-14) << node << " " << k;
  }
  int mine[2] = {compared, closed}, all[2];
  Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_SUM, 2, mine, all);
  EXPECT_EQ(all[0], 5);
  EXPECT_GT(all[1], 0);

  surfaces.slave.pop_back();
  surfaces.fixed.assign(surfaces.size(), {});
  const Fixture other(surfaces, Tpetra::getDefaultComm());
  EXPECT_THROW(other.contact->carry_over(*before.contact, accepted), std::invalid_argument);
}

}  // namespace
}  // namespace mortise
