// The guess for a body that nothing but a regularised contact holds: it comes up to the other side until it bears a small pressure.

#include <gtest/gtest.h>

#include "mortise/contact/formulation/penalty.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;

constexpr double height = 0.3, reach = 0.5, youngs_modulus = 100.0, stiffness = 20.0;

enum class Unheld { nothing, slave, master, both };

/// A flat slave over a flat master, with a penalty.
struct Flat {
  explicit Flat(int dimension, double above = height, double slope = 0.0, std::optional<std::size_t> prescribed = {})
      : surfaces(make_surfaces(dimension, above, slope, prescribed)), fixture(surfaces, Tpetra::getDefaultComm()), contact(*fixture.contact) {}

  static test::TwoSurfaces make_surfaces(int dimension, double above, double slope, std::optional<std::size_t> prescribed) {
    test::TwoSurfaces flat = dimension == 2 ? test::arch_on_ground() : test::dome_on_waves();
    const auto up = static_cast<std::size_t>(dimension - 1);
    for (test::Point& point : flat.slave) point[up] = above + slope * (point[0] - flat.slave[0][0]);
    for (test::Point& point : flat.master) point[up] = 0.0;
    const auto penalty = std::make_shared<Penalty>();
    penalty->normal = stiffness;
    flat.options.formulation.options = penalty;
    flat.options.mortar.search_reach = reach;
    if (prescribed) flat.fixed[*prescribed][up] = true;
    return flat;
  }

  bool is_slave(GlobalOrdinal node) const { return node < static_cast<GlobalOrdinal>(surfaces.slave.size()); }

  /// The guess of a step that starts from `d`.
  RCP<Vector> start(Unheld unheld, const RCP<Vector>& d) {
    std::vector<char> flags;
    for (const GlobalOrdinal node : fixture.nodes->getNodeElementList())
      flags.push_back(unheld == Unheld::both || (unheld == Unheld::slave && is_slave(node)) || (unheld == Unheld::master && !is_slave(node)));
    Vector z(contact.multiplier_map());
    contact.start_step(*d, flags, z);
    EXPECT_EQ(z.normInf(), 0.0);  // tractions follow from the displacements
    return d;
  }
  RCP<Vector> start(Unheld unheld) { return start(unheld, rcp(new Vector(fixture.dofs))); }

  /// Displacements have to be those of `motion(node, component)`.
  void expect_motion(const Vector& d, const std::function<double(GlobalOrdinal, int)>& motion, double tolerance) {
    const auto values = d.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const GlobalOrdinal dof : fixture.dofs->getNodeElementList()) {
      const GlobalOrdinal node = dof / surfaces.dimension;
      const int component = static_cast<int>(dof % surfaces.dimension);
      EXPECT_NEAR(values(fixture.dofs->getLocalElement(dof), 0), motion(node, component), tolerance) << "node " << node << ", " << component;
    }
  }

  /// The largest pressure at displacement d: C = theta (z - p) at z = 0, theta = 1 / (1 + stiffness). Collective.
  double pressure(const Vector& d) {
    std::optional<StepFailure> failure;
    contact.evaluate(d, false, failure);
    EXPECT_FALSE(failure);
    const Vector z(contact.multiplier_map());
    Vector C(contact.multiplier_map());
    contact.complementarity(z, C);
    return (1.0 + stiffness) * C.normInf();
  }

  test::TwoSurfaces surfaces;
  Fixture fixture;
  ContactSystem& contact;
};

class Approach : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Approach, ::testing::Values(2, 3));

TEST_P(Approach, AnUnheldSideComesUpAndBearsASmallPressure) {
  const int up = GetParam() - 1;
  for (const Unheld unheld : {Unheld::slave, Unheld::master}) {
    Flat flat(GetParam());
    const auto d = flat.start(unheld);
    // beyond the distance goes what the pressure 1e-6 E takes: 1e-6 h / stiffness
    flat.expect_motion(
        *d,
        [&](GlobalOrdinal node, int component) {
          if (component != up || flat.is_slave(node) != (unheld == Unheld::slave)) return 0.0;
          return unheld == Unheld::slave ? -height : height;
        },
        1e-6);
    EXPECT_NEAR(flat.pressure(*d), 1e-6 * youngs_modulus, 1e-6 * 1e-6 * youngs_modulus);
    for (const auto& state : flat.contact.node_states(0, Vector(flat.contact.multiplier_map())))
      EXPECT_TRUE(state.closed || !(state.covered > 0.0)) << "node " << state.node;
  }
}

TEST_P(Approach, StartsFromTheGuessThatItIsGiven) {
  const int up = GetParam() - 1;
  Flat flat(GetParam());
  const auto guess = [&](GlobalOrdinal node, int component) { return component == up && flat.is_slave(node) ? -0.1 : component == 0 ? 0.02 : 0.0; };
  const auto d =
      flat.start(Unheld::slave,
                 Fixture::vector(flat.fixture.dofs, [&](GlobalOrdinal dof) { return guess(dof / GetParam(), static_cast<int>(dof % GetParam())); }));
  flat.expect_motion(
      *d, [&](GlobalOrdinal node, int component) { return component == up && flat.is_slave(node) ? -height : guess(node, component); }, 1e-6);
}

// Along the normal of the node that is nearest: it alone closes.
TEST(ApproachInThePlane, OfATiltedSideIsThatOfTheNearestNode) {
  const double slope = 0.05;
  Flat flat(2, height, slope);
  const auto d = flat.start(Unheld::slave);
  const double length = std::hypot(1.0, slope), way = height * length, normal[] = {slope / length, -1.0 / length};
  flat.expect_motion(
      *d, [&](GlobalOrdinal node, int component) { return flat.is_slave(node) ? way * normal[component] : 0.0; }, 1e-6);
  EXPECT_NEAR(flat.pressure(*d), 1e-6 * youngs_modulus, 1e-6 * 1e-6 * youngs_modulus);
}

TEST_P(Approach, PrescribedComponentsStay) {
  const int up = GetParam() - 1;
  const std::size_t prescribed = 2;
  Flat flat(GetParam(), height, 0.0, prescribed);
  flat.expect_motion(
      *flat.start(Unheld::slave),
      [&](GlobalOrdinal node, int component) {
        return component == up && flat.is_slave(node) && node != static_cast<GlobalOrdinal>(prescribed) ? -height : 0.0;
      },
      1e-6);
}

TEST_P(Approach, NothingMovesThatIsHeldOrIsTooFarOrHasNoOtherSide) {
  const auto stays = [](Flat& flat, Unheld unheld) { EXPECT_EQ(flat.start(unheld)->normInf(), 0.0); };
  Flat away(GetParam()), far(GetParam(), 1.2 * reach);
  stays(away, Unheld::nothing);
  stays(away, Unheld::both);
  stays(far, Unheld::slave);
  stays(far, Unheld::master);
}

}  // namespace
}  // namespace mortise
