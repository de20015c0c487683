// Rows of heat across contact: derivatives against central differences, balance, invariance under rotations.
#include "../contact/linearised_cases.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double time_step = 0.1;

/// h = 2 + p (0.3 + 0.05 sin theta) + 0.1 v p: that of the medium where surfaces just touch.
std::shared_ptr<const ConductanceLaw> of_everything() {
  const auto law = std::make_shared<ConductanceFunction>();
  law->conductance =
      ScalarFunction([](const std::vector<double>& of) { return 2.0 + of[0] * (0.3 + 0.05 * std::sin(of[1])) + 0.1 * of[2] * of[0]; }, "h");
  return law;
}
std::shared_ptr<const GapConductance> of_medium() {
  const auto law = std::make_shared<MediumConductance>();
  law->conductivity = 0.2;
  law->distance = 0.1;
  return law;
}

/// No node bears exactly 0, where conductances have a kink.
double pressing(std::size_t node) { return pressure(node) + 0.05; }

/// A host with displacements and temperatures, at an iterate.
struct Host {
  Host(const TwoSurfaces& surfaces, const ThermalPair& pair)
      : fixture(surfaces, Tpetra::getDefaultComm(), HostNumbering::interleaved, true), heat(contact, fixture.scalar_field(), fixture.dofs, {pair}) {}
  ContactHistory history(const Vector& d, const Vector& z) const {
    const auto before = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * std::sin(3.1 * static_cast<double>(id) + 0.2); });
    Vector guess(contact.multiplier_map());
    const ContactHistory started = fixture.first_step(*before, guess);
    return updated(contact, contact.evaluate(d, started).laws(z), started);
  }
  /// Temperatures where the scalar field is, displacements elsewhere.
  RCP<Vector> state() const {
    return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return fixture.is_scalar(id) ? 3.0 * wiggle(id) : 0.01 * wiggle(id); });
  }
  RCP<Vector> rows(const Vector& x, const Vector& z, const ContactHistory& history) const {
    const auto r = rcp(new Vector(fixture.dofs));
    heat.evaluate(contact.evaluate(x, history).laws(z), x, time_step).add_to(*r);
    return r;
  }

  Fixture fixture;
  const ContactSystem& contact = *fixture.contact;
  ThermalContact heat;
};

ThermalPair with_everything() { return {0, of_everything(), of_medium(), 0.3}; }

class RowsOfHeat : public ::testing::TestWithParam<int> {};

TEST_P(RowsOfHeat, HaveTheDerivativesOfDifferences) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  // Derivatives by displacements at edges that cross at a small angle have the error of the rule (field_transfer_test).
  const bool has_error_of_rule = one.name == "quadratic, space, hardly covered, triangles";
  const Host host(one.surfaces, with_everything());
  const RCP<Vector> x = host.state(), z = host.fixture.multipliers(pressing);
  const ContactHistory history = host.history(*x, *z);
  const DifferentiatedContact at = host.contact.differentiate(*x, history);
  const ContactLaws laws = at.laws(*z);
  const DifferentiatedHeat heat = host.heat.differentiate(at.linearise(laws), *x, time_step);
  Vector r(host.fixture.dofs);
  heat.add_to(r);
  EXPECT_GT(r.norm2(), 0.0);

  const auto of_temperatures = [&](GlobalOrdinal id) { return host.fixture.is_scalar(id) ? wiggle(3 * id + 1) : 0.0; };
  const auto of_displacements = [&](GlobalOrdinal id) { return host.fixture.is_scalar(id) ? 0.0 : wiggle(3 * id + 1); };
  const RCP<Vector> still = rcp(new Vector(host.fixture.dofs)), no_traction = rcp(new Vector(host.contact.multiplier_map()));
  const std::vector<std::pair<RCP<Vector>, RCP<Vector>>> directions = {
      {Fixture::vector(host.fixture.dofs, of_temperatures), no_traction},
      {Fixture::vector(host.fixture.dofs, of_displacements), no_traction},
      {still, Fixture::vector(host.contact.multiplier_map(), [](GlobalOrdinal id) { return wiggle(5 * id + 2); })}};
  for (std::size_t block = 0; block < directions.size(); ++block) {
    SCOPED_TRACE(block);
    const auto& [v, w] = directions[block];
    Vector slope(host.fixture.dofs), difference(host.fixture.dofs);
    heat.of_dofs()->apply(*v, slope);
    heat.of_multipliers()->apply(*w, slope, Teuchos::NO_TRANS, 1.0, 1.0);
    const double h = 1e-6;
    for (const double sign : {1.0, -1.0}) {
      Vector x_h(*x, Teuchos::Copy), z_h(*z, Teuchos::Copy);
      x_h.update(sign * h, *v, 1.0);
      z_h.update(sign * h, *w, 1.0);
      difference.update(sign / (2.0 * h), *host.rows(x_h, z_h, history), 1.0);
    }
    const double size = slope.norm2();
    difference.update(-1.0, slope, 1.0);
    if (block == 0 || one.surfaces.options.geometry == ContactGeometry::current) {
      EXPECT_GT(size, 0.0);
    }
    if (block == 1 && has_error_of_rule) continue;
    EXPECT_LE(difference.norm2(), 1e-6 * size);
  }
}

// Of conduction nothing is left in the sum of all rows; of friction minus its power, which is not negative anywhere.
TEST_P(RowsOfHeat, Balance) {
  const Case one = cases()[GetParam()];
  SCOPED_TRACE(one.name);
  const Host host(one.surfaces, with_everything());
  const RCP<Vector> x = host.state(), z = host.fixture.multipliers(pressing);
  const ContactHistory history = host.history(*x, *z);
  const ContactHeat heat = host.heat.evaluate(host.contact.evaluate(*x, history).laws(*z), *x, time_step);
  Vector r(host.fixture.dofs), ones(host.fixture.dofs);
  heat.add_to(r);
  for (const GlobalOrdinal id : local_ids(*host.fixture.dofs)) ones.replaceGlobalValue(id, host.fixture.is_scalar(id) ? 1.0 : 0.0);
  const HeatFlow flow = heat.flow(0);
  EXPECT_NEAR(r.dot(ones), -flow.friction, 1e-12 * (r.norm1() + std::abs(flow.friction)));
  EXPECT_EQ(flow.to_slave_without_rows, 0.0);
  EXPECT_EQ(flow.to_master_without_rows, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Cases, RowsOfHeat, ::testing::ValuesIn(indices(false)), test_name);

// Everything turns by 90 degrees in one step: no slip, no heat, and the rows of any temperatures stay what they were.
TEST(RowsOfHeatOfATurn, StayWhatTheyAre) {
  for (TwoSurfaces surfaces : {arch_on_ground(), dome_on_waves()}) {
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(0.12);
    surfaces.options.friction.options = coulomb;
    surfaces.options.mortar.search_reach = 1.0;
    const Host host(surfaces, with_everything());
    const int dimension = surfaces.dimension;
    const ContactSystem& contact = host.contact;
    Vector rest(host.fixture.dofs), turned(host.fixture.dofs), guess(contact.multiplier_map());
    const ContactHistory history = host.fixture.first_step(rest, guess);
    // (x, y) -> (-y, x) in the plane; in space about the first axis, (y, z) -> (-z, y).
    const int a = dimension - 2, b = dimension - 1;
    for (const GlobalOrdinal node : local_ids(*host.fixture.nodes)) {
      const auto id = static_cast<std::size_t>(node);
      const Point X = id < surfaces.slave.size() ? surfaces.slave[id] : surfaces.master[id - surfaces.slave.size()];
      turned.replaceGlobalValue(host.fixture.number(dimension * node + a), -X[b] - X[a]);
      turned.replaceGlobalValue(host.fixture.number(dimension * node + b), X[a] - X[b]);
    }
    const RCP<Vector> z = host.fixture.multipliers([](std::size_t) { return 3.0; });
    Vector z_turned(*z, Teuchos::Copy);
    {
      const auto from = z->getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto to = z_turned.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (std::size_t first = 0; first < from.extent(0); first += static_cast<std::size_t>(dimension)) {
        to(first + a, 0) = -from(first + b, 0);
        to(first + b, 0) = from(first + a, 0);
      }
    }
    const auto add_temperatures = [&](Vector& x, const std::function<double(GlobalOrdinal)>& theta) {
      for (const GlobalOrdinal id : local_ids(*host.fixture.dofs))
        if (host.fixture.is_scalar(id)) x.replaceGlobalValue(id, theta(id));
    };
    const auto uniform = [](GlobalOrdinal) { return 7.0; };
    add_temperatures(turned, uniform);
    const RCP<Vector> nothing = host.rows(turned, z_turned, history);
    add_temperatures(rest, [](GlobalOrdinal id) { return 7.0 + wiggle(id); });
    add_temperatures(turned, [](GlobalOrdinal id) { return 7.0 + wiggle(id); });
    const RCP<Vector> before = host.rows(rest, *z, history);
    RCP<Vector> after = host.rows(turned, z_turned, history);
    EXPECT_GT(before->norm2(), 0.0);
    EXPECT_LE(nothing->normInf(), 1e-12 * 7.0 * before->normInf());
    after->update(-1.0, *before, 1.0);
    EXPECT_LE(after->normInf(), 1e-12 * 7.0 * before->normInf());
  }
}

}  // namespace
}  // namespace mortise
