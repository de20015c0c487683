// Slip: objective, additive along a straight surface, zero in a rigid motion of both bodies; its path and its work.

#include <gtest/gtest.h>

#include "linearised_cases.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;

/// A straight slave of 5 facets over [1, 6] on a straight master of 6 over [0, 9]; slave nodes have ids 0 to 5.
TwoSurfaces flat(ContactGeometry geometry, double coefficient) {
  TwoSurfaces surfaces;
  for (int i = 0; i < 6; ++i) surfaces.slave.push_back({1.0 + i, 0.0});
  for (int i = 0; i < 7; ++i) surfaces.master.push_back({1.5 * (6 - i), 0.0});
  surfaces.fixed.assign(surfaces.size(), {false, false});
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(coefficient);
  surfaces.options.friction.options = coulomb;
  surfaces.options.geometry = geometry;
  return surfaces;
}

RCP<Vector> motion(const Fixture& fixture, const TwoSurfaces& surfaces, const std::function<test::Point(bool slave, const test::Point&)>& u) {
  return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) {
    const auto node = static_cast<std::size_t>(id / 2);
    const bool slave = node < surfaces.slave.size();
    return u(slave, slave ? surfaces.slave[node] : surfaces.master[node - surfaces.slave.size()])[id % 2];
  });
}

/// Slips of the slave nodes at d of a step that started without displacement.
std::vector<double> slips(const Fixture& fixture, const Vector& d) {
  Vector none(fixture.dofs), z(fixture.contact->multiplier_map());
  const ContactHistory history = fixture.first_step(none, z);
  std::vector<double> slips;
  for (const auto& state : node_states(fixture.contact->evaluate(d, history).laws(z), 0)) slips.push_back(state.slip);
  return slips;
}

// The slave's normal points down, its tangent along +x.
TEST(Slip, IsTheMotionOfTheSlaveRelativeToTheMaster) {
  for (const ContactGeometry geometry : {ContactGeometry::current, ContactGeometry::reference}) {
    const TwoSurfaces surfaces = flat(geometry, 0.3);
    Fixture fixture(surfaces, Tpetra::getDefaultComm());
    const auto d = motion(fixture, surfaces, [](bool slave, const test::Point&) { return test::Point{slave ? 0.7 : -0.2, 0.0}; });
    for (const double slip : slips(fixture, *d)) EXPECT_NEAR(slip, 0.9, 1e-13);
  }
}

TEST(Slip, VanishesInARigidMotionOfBothBodies) {
  const TwoSurfaces surfaces = flat(ContactGeometry::current, 0.3);
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const double angle = 1.1;
  const auto d = motion(fixture, surfaces, [&](bool, const test::Point& X) {
    return test::Point{std::cos(angle) * X[0] - std::sin(angle) * X[1] - X[0] + 3.0, std::sin(angle) * X[0] + std::cos(angle) * X[1] - X[1] - 2.0};
  });
  for (const double slip : slips(fixture, *d)) EXPECT_NEAR(slip, 0.0, 1e-13);
}

// Beyond a whole master facet: the old master nodes are no longer near.
TEST(Slip, IsMeasuredOverManyFacets) {
  const TwoSurfaces surfaces = flat(ContactGeometry::current, 0.3);
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const auto d = motion(fixture, surfaces, [](bool slave, const test::Point&) { return test::Point{slave ? 3.0 : 0.0, 0.0}; });
  for (const double slip : slips(fixture, *d)) EXPECT_NEAR(slip, 3.0, 1e-12);
}

/// Slips as components along the tangents, over what is covered, of nodes that are wholly covered: of a step from d0 to d.
std::vector<double> slips_of_step(const Fixture& fixture, const ContactHistory& history, const Vector& d) {
  Vector z(fixture.contact->multiplier_map());
  std::vector<double> slips;
  for (const auto& state : node_states(fixture.contact->evaluate(d, history).laws(z), 0))
    if (state.covered > 0.3 * state.weight) slips.push_back(state.slip);
  return slips;
}

// Slip against what the node faces now, and against what it faced at the start: the two differ by the square of the step.
TEST(Slip, OfANewlyCoveredNodeIsThatOfAnOlderOneToSecondOrder) {
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  for (const bool quadratic : {false, true})
    for (TwoSurfaces surfaces : {test::arch_on_ground(), test::dome_on_waves(), test::dome_on_waves(true)}) {
      if (quadratic) surfaces = test::quadratic(surfaces, true, true);
      SCOPED_TRACE(surfaces.dimension);
      surfaces.options.friction.options = coulomb;
      surfaces.options.mortar.search_reach = 1.0;
      Fixture fixture(surfaces, Tpetra::getDefaultComm());
      Vector none(fixture.dofs), z(fixture.contact->multiplier_map());
      const ContactHistory older = fixture.first_step(none, z), newly = test::without_couplings(older);
      const GlobalOrdinal dim = surfaces.dimension;
      std::vector<double> largest, differences;
      for (const double step : {0.02, 0.01, 0.005}) {
        // The slave slides by 1.5 steps and turns by a step, with what it lies on, and both strain.
        const auto d = Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) {
          const auto node = static_cast<std::size_t>(id / dim), i = static_cast<std::size_t>(id % dim);
          const bool slave = node < surfaces.slave.size();
          const test::Point& X = slave ? surfaces.slave[node] : surfaces.master[node - surfaces.slave.size()];
          const auto up = static_cast<std::size_t>(dim - 1);
          const double slid = slave && i == 0 ? 1.5 : 0.0, turned = i == 0 ? -X[up] : (i == up ? X[0] : 0.0);
          return step * (slid + turned + 0.1 * test::wiggle(id));
        });
        const std::vector<double> a = slips_of_step(fixture, older, *d), b = slips_of_step(fixture, newly, *d);
        ASSERT_EQ(a.size(), b.size());
        double mine[2] = {0.0, 0.0}, all[2];
        for (std::size_t s = 0; s < a.size(); ++s) {
          mine[0] = std::max(mine[0], std::abs(a[s]));
          mine[1] = std::max(mine[1], std::abs(a[s] - b[s]));
        }
        Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_MAX, 2, mine, all);
        largest.push_back(all[0]);
        differences.push_back(all[1]);
      }
      EXPECT_GT(largest[2], 0.5 * largest[1] * 0.9);
      EXPECT_LT(differences[0], 0.2 * largest[0]);
      for (int k = 0; k < 2; ++k) EXPECT_LT(differences[k + 1], 0.3 * differences[k]);  // a quarter
    }
}

// Both bodies turn and move as one, by any angle, after they slid a little.
TEST(Slip, OfANewlyCoveredNodeIsObjective) {
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  for (TwoSurfaces surfaces : {test::arch_on_ground(), test::corner_on_ground(), test::dome_on_waves(), test::dome_on_waves(true)}) {
    const GlobalOrdinal dim = surfaces.dimension;
    SCOPED_TRACE(dim);
    surfaces.options.friction.options = coulomb;
    surfaces.options.mortar.search_reach = 1.0;
    Fixture fixture(surfaces, Tpetra::getDefaultComm());
    Vector none(fixture.dofs), z(fixture.contact->multiplier_map());
    const ContactHistory history = test::without_couplings(fixture.first_step(none, z));
    const auto moved = [&](const Eigen::Matrix3d& turn, double slide) {
      return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) {
        const auto node = static_cast<std::size_t>(id / dim);
        const bool slave = node < surfaces.slave.size();
        const test::Point& X = slave ? surfaces.slave[node] : surfaces.master[node - surfaces.slave.size()];
        const Eigen::Vector3d start(X[0], X[1], X[2]), slid = start + slide * (slave ? Eigen::Vector3d(0.3, 0.0, 0.0) : Eigen::Vector3d::Zero());
        return (turn * slid + (turn.isIdentity() ? 0.0 : 1.0) * Eigen::Vector3d(3.0, -2.0, 1.0) - start)[id % dim];
      });
    };
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity(), about_z = Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()).matrix(),
                          skew = Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).matrix();
    for (const Eigen::Matrix3d& turn : {about_z, dim == 2 ? about_z : skew}) {
      for (const double slip : slips_of_step(fixture, history, *moved(turn, 0.0))) EXPECT_NEAR(slip, 0.0, 1e-12);
      const std::vector<double> as_it_was = slips_of_step(fixture, history, *moved(identity, 1.0));
      const std::vector<double> turned = slips_of_step(fixture, history, *moved(turn, 1.0));
      ASSERT_EQ(turned.size(), as_it_was.size());
      for (std::size_t s = 0; s < turned.size(); ++s) {
        EXPECT_NEAR(std::abs(turned[s]), std::abs(as_it_was[s]), 1e-12);
        EXPECT_GT(std::abs(as_it_was[s]), 0.1);
      }
    }
  }
}

TEST(Slip, PathAndWorkGrowWithAcceptedSteps) {
  const TwoSurfaces surfaces = flat(ContactGeometry::current, 0.3);
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const double pressure = 10.0;
  // z = (shear, -p): normal down. Forward by 0.5, back by 0.2: the shear traction follows the slip.
  const GlobalOrdinal offset = fixture.dofs->getMaxAllGlobalIndex() + 1;
  const auto traction = [&](double shear) {
    return Fixture::vector(contact.multiplier_map(), [&](GlobalOrdinal id) { return (id - offset) % 2 == 0 ? shear : -pressure; });
  };
  Vector z(contact.multiplier_map());
  RCP<Vector> d = rcp(new Vector(fixture.dofs));
  ContactHistory accepted = contact.initial_history(*d);
  double path = 0.0, position = 0.0;
  for (const double step : {0.5, -0.2}) {
    ContactHistory history = accepted;
    for (int tries = 0; tries < 2; ++tries) history = contact.start_step(accepted, *d, z);  // undone and tried again
    position += step;
    const RCP<Vector> before = d;
    d = motion(fixture, surfaces, [&](bool slave, const test::Point&) { return test::Point{slave ? position : 0.0, 0.0}; });
    const ContactEvaluation at = contact.evaluate(*d, history);
    Tpetra::deep_copy(z, *traction(step > 0.0 ? 0.3 * pressure : -0.3 * pressure));
    const ContactLaws laws = at.laws(z);
    const ContactNorms norms = laws.norms(history->states);
    EXPECT_EQ(norms.active, 6);
    EXPECT_EQ(norms.sticking, 0);
    EXPECT_LE(norms.complementarity, 1e-13);  // the closed solution: on the cone, along the slip
    accepted = contact.commit(laws);
    path += std::abs(step);
    for (const auto& state : node_states(laws, 0)) {
      EXPECT_NEAR(state.slip_path, path, 1e-12);
      EXPECT_EQ(state.state, ContactState::slip);
    }
    // The forces of the shear tractions alone: traction times slip over a length of 5.
    Vector force(fixture.dofs), change(*d, Teuchos::Copy);
    at.add_force(*at.shear_tractions(z), force);
    change.update(-1.0, *before, 1.0);
    EXPECT_NEAR(force.dot(change), 0.3 * pressure * 5.0 * std::abs(step), 1e-10);
  }
  EXPECT_GT(friction_bytes(accepted), 0);
  EXPECT_GT(contact.friction_evaluations(), 0);
}

// With ties bearing shear, in stick: a step in which nothing changes has no slip, after tries that were undone and in a rigid motion too. The
// give of ties is a part of slip only as far as it changes.
TEST(Slip, OfTiedNodesVanishesInADwell) {
  TwoSurfaces plane = test::arch_on_ground();
  for (test::Point& x : plane.master) x[0] *= 4.15 / 4.6;
  auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(3.0);
  for (TwoSurfaces surfaces : {plane, test::hardly_covered(test::dome_on_waves()), test::hardly_covered_at_a_corner(test::dome_on_waves(true))}) {
    const int dimension = surfaces.dimension;
    SCOPED_TRACE(dimension);
    surfaces.options.friction.options = coulomb;
    Fixture fixture(surfaces, Tpetra::getDefaultComm());
    const ContactSystem& contact = *fixture.contact;
    const auto z = fixture.multipliers([](std::size_t node) { return 5.0 + std::sin(1.3 * static_cast<double>(node)); });
    Vector d(fixture.dofs), guess(contact.multiplier_map());
    const GlobalOrdinal offset = fixture.dofs->getMaxAllGlobalIndex() + 1;
    ContactHistory history = fixture.first_step(d, guess);
    const auto largest_slip_condition = [&](const Vector& at, const Vector& multipliers) {
      const ContactLaws laws = contact.evaluate(at, history).laws(multipliers);
      EXPECT_GT(laws.norms(history->states).sticking, 0);
      Vector C(contact.multiplier_map());
      laws.complementarity(C);
      double mine = 0.0, all = 0.0;
      for (const auto& state : node_states(laws, 0)) {
        if (state.state != ContactState::stick) continue;
        for (int i = 1; i < dimension; ++i) {
          const LocalOrdinal row = C.getMap()->getLocalElement(offset + dimension * state.node + i);
          mine = std::max(mine, std::abs(C.getLocalViewHost(Tpetra::Access::ReadOnly)(row, 0)));
        }
      }
      Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
      return all;
    };
    EXPECT_GT(largest_slip_condition(d, *z), 1e-2);  // the first shear of the ties counts
    const ContactHistory accepted = contact.commit(contact.evaluate(d, history).laws(*z));
    for (int tries = 0; tries < 2; ++tries) {
      history = contact.start_step(accepted, d, guess);
      EXPECT_LE(largest_slip_condition(d, *z), 1e-12);
      Vector changed(*z, Teuchos::Copy);
      changed.scale(1.1);
      EXPECT_GT(largest_slip_condition(d, changed), 1e-3);
    }
    if (dimension > 2) continue;
    const double angle = 1.1, c = std::cos(angle), s = std::sin(angle);
    const auto turned = motion(fixture, surfaces, [&](bool, const test::Point& X) {
      return test::Point{c * X[0] - s * X[1] - X[0] + 3.0, s * X[0] + c * X[1] - X[1] - 2.0};
    });
    const auto turned_z = rcp(new Vector(contact.multiplier_map()));
    for (std::size_t k = 0; k < turned_z->getLocalLength(); k += 2) {
      const auto from = z->getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto to = turned_z->getLocalViewHost(Tpetra::Access::ReadWrite);
      to(k, 0) = c * from(k, 0) - s * from(k + 1, 0);
      to(k + 1, 0) = s * from(k, 0) + c * from(k + 1, 0);
    }
    EXPECT_LE(largest_slip_condition(*turned, *turned_z), 1e-10);
  }
}

TEST(Slip, APairWithoutFrictionRemembersNothing) {
  TwoSurfaces surfaces = flat(ContactGeometry::current, 0.3);
  surfaces.options.friction = ContactOptions().friction;
  Fixture fixture(surfaces, Tpetra::getDefaultComm());
  Vector d(fixture.dofs), z(fixture.contact->multiplier_map());
  const ContactEvaluation at = fixture.contact->evaluate(d, fixture.first_step(d, z));
  EXPECT_EQ(friction_bytes(fixture.contact->commit(at.laws(z))), 0);
  EXPECT_EQ(fixture.contact->friction_evaluations(), 0);
  z.putScalar(1.0);
  EXPECT_EQ(at.shear_tractions(z)->norm2(), 0.0);
}

TEST(Coulomb, SticksInsideTheConeAndSlipsOnIt) {
  const Frame frame = make_frame(Eigen::Vector2d(0.0, -1.0), 0);
  const double c = 7.0;
  const auto at = [&](double shear, double slip) {
    return with_friction(c, c, 0.0, TangentVector::Constant(1, slip), frame, Eigen::Vector2d(shear, -10.0), {3.0, 0.3});
  };
  EXPECT_EQ(at(2.9, 0.0).state, ContactState::stick);
  EXPECT_EQ(at(2.9, 0.0).C[1], 0.0);
  EXPECT_EQ(at(-2.9, -0.1).state, ContactState::slip);
  EXPECT_NEAR(at(-3.0, -0.1).C[1], 0.0, 1e-15);
  EXPECT_NEAR(at(3.0, -0.1).C[1], -c * -0.1, 1e-15);  // slips against its traction: sticks instead
}

// Round-off of a traction at the bound does not choose the derivative, and nothing changes C.
TEST(Coulomb, SlipsAtTheBoundUpToRoundOff) {
  const double c = 7.0, rho = 3.0;
  const auto sticks = [](const Complementarity& node) { return node.state == ContactState::stick; };
  const auto plane = [&](double shear, double slip) {
    const Frame frame = make_frame(Eigen::Vector2d(0.0, -1.0), 0);
    return with_friction(c, c, 0.0, TangentVector::Constant(1, slip), frame, Eigen::Vector2d(shear, -10.0), {rho, 0.3});
  };
  const auto space = [&](double shear, double slip) {  // along a direction between the tangents
    const Frame frame = make_frame(Eigen::Vector3d(0.0, 0.0, -1.0), 0);
    const Eigen::Vector2d along(0.6, 0.8);
    const SpatialVector z = 10.0 * frame.normal + frame.tangents.transpose() * (shear * along);
    return with_friction(c, c, 0.0, slip * along, frame, z, {rho, 0.3});
  };
  for (const double off : {-1e-10, -1e-15, 0.0, 1e-15, 1e-10}) {
    EXPECT_FALSE(sticks(plane(rho * (1.0 + off), 0.0))) << off;
    EXPECT_FALSE(sticks(space(rho * (1.0 + off), 0.0))) << off;
  }
  for (const double slip : {-0.1, 0.0, 0.1}) {
    const double shear = rho * (1.0 - 1e-10) - c * slip;  // |y| just below the bound: C of stick
    EXPECT_NEAR(plane(shear, slip).C[1], -c * slip, 1e-14);
    EXPECT_NEAR((space(shear, slip).C.tail(2) + c * slip * Eigen::Vector2d(0.6, 0.8)).norm(), 0.0, 1e-14);
  }
  EXPECT_TRUE(sticks(plane(rho * (1.0 - 1e-8), 0.0)));
  EXPECT_TRUE(sticks(space(rho * (1.0 - 1e-8), 0.0)));
}

// A node that closed a gap bears  p u / g0,  whatever the constant is, up to the bound: it came along that way.
TEST(Coulomb, OfANodeThatClosedAGapLiesAlongItsWay) {
  for (const double c : {0.7, 7.0, 70.0})
    for (const double slip : {-0.02, 0.004, 0.012, 0.1}) {
      const double pressure = 10.0, start = 0.05, traction = std::clamp(pressure * slip / start, -3.0, 3.0);
      const Frame plane = make_frame(Eigen::Vector2d(0.0, -1.0), 0), space = make_frame(Eigen::Vector3d(0.0, 0.0, -1.0), 0);
      const FrictionBound bound{3.0, 0.3};
      const auto in_plane = with_friction(c, c, 0.0, TangentVector::Constant(1, slip), plane, Eigen::Vector2d(traction, -pressure), bound, start);
      const TangentVector along = Eigen::Vector2d(0.6, -0.8);
      const auto in_space = with_friction(c, c, 0.0, slip * along, space,
                                          SpatialVector(pressure * space.normal + space.tangents.transpose() * (traction * along)), bound, start);
      EXPECT_NEAR(in_plane.C[1], 0.0, 1e-13) << c << " " << slip;
      EXPECT_NEAR(in_space.C.tail(2).norm(), 0.0, 1e-13) << c << " " << slip;
      EXPECT_EQ(in_plane.state == ContactState::stick, std::abs(traction) < 3.0);
      EXPECT_EQ(in_space.state == ContactState::stick, std::abs(traction) < 3.0);
    }
}

// Newton's method leaves the traction on a tangent of the circle: longer than the bound by its turn, which must not hide that it slips the wrong way.
TEST(Coulomb, SticksWhereItSlipsAgainstATurnedTraction) {
  const double c = 7.0, rho = 3.0, turn = 0.1;
  const Frame frame = make_frame(Eigen::Vector3d(0.0, 0.0, -1.0), 0);
  const Eigen::Vector2d before(0.6, 0.8), across(-0.8, 0.6);
  const auto at = [&](double slip) {
    const SpatialVector z = 10.0 * frame.normal + frame.tangents.transpose() * (rho * (before + std::tan(turn) * across));
    return with_friction(c, c, 0.0, slip * before, frame, z, {rho, 0.3});
  };
  const double excess = rho / std::cos(turn) - rho;  // of the traction
  for (const double reversed : {0.2 * excess, 0.9 * excess, 2.0 * excess, 0.5 * rho}) {
    const Complementarity node = at(-reversed / c);
    EXPECT_EQ(node.state, ContactState::stick) << reversed;
    EXPECT_NEAR((node.C.tail(2) - reversed * before).norm(), 0.0, 1e-14) << reversed;  // no less than a tenth of the excess
  }
  EXPECT_EQ(at(-0.05 * excess / c).state, ContactState::slip);  // far beyond the bound for so little slip
  EXPECT_EQ(at(0.0).state, ContactState::slip);
  EXPECT_EQ(at(0.2 * excess / c).state, ContactState::slip);
  EXPECT_EQ(at(-3.0 * rho / c).state, ContactState::slip);  // far enough to turn the traction round
}

}  // namespace
}  // namespace mortise
