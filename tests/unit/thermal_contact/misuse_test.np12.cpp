// Bodies without temperatures, and what is refused.
#include "../contact/linearised_cases.hpp"
#include "mortise/core/over_ranks.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise {
namespace {

using namespace test;

std::shared_ptr<const ConductanceLaw> constant(double h) {
  const auto law = std::make_shared<ConstantConductance>();
  law->value = h;
  return law;
}
std::shared_ptr<const ConductanceLaw> function(const ScalarFunction::Body& body) {
  const auto law = std::make_shared<ConductanceFunction>();
  law->conductance = ScalarFunction(body, "h");
  return law;
}

TwoSurfaces rubbing() {
  TwoSurfaces surfaces = arch_on_ground();
  const auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.05);
  surfaces.options.friction.options = coulomb;
  surfaces.options.mortar.search_reach = 1.0;
  return surfaces;
}

/// Contact at an iterate of a host whose further field may be that of the temperature.
struct Host {
  explicit Host(bool transfers = true) : fixture(rubbing(), Tpetra::getDefaultComm(), HostNumbering::interleaved, transfers) {
    Vector guess(contact.multiplier_map());
    const Vector rest(fixture.dofs);
    const ContactHistory history = fixture.first_step(rest, guess);
    at = contact.differentiate(*x, history);
    laws = at->laws(*fixture.multipliers(pressure));
  }
  /// The scalar field, without rows on the master.
  NodalField on_slave_alone() const {
    std::vector<GlobalOrdinal> ids;
    const NodalField all = fixture.scalar_field();
    for (std::size_t n = 0; n < local_id_count(*fixture.nodes); ++n) {
      const auto node = static_cast<LocalOrdinal>(n);
      const bool is_slave = fixture.nodes->getGlobalElement(node) < static_cast<GlobalOrdinal>(rubbing().slave.size());
      ids.push_back(is_slave ? all.id(node, 0) : NodalField::none);
    }
    return {"temperature", fixture.nodes, 1, ids};
  }
  ThermalContact thermal(const ThermalPair& pair) const { return {contact, fixture.scalar_field(), fixture.dofs, {pair}}; }

  Fixture fixture;
  const ContactSystem& contact = *fixture.contact;
  RCP<Vector> x = Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return fixture.is_scalar(id) ? 3.0 + wiggle(id) : 0.01 * wiggle(id); });
  std::optional<DifferentiatedContact> at;
  std::optional<ContactLaws> laws;
};

// A master without a temperature takes its share of the heat of friction out of the model.
TEST(BodyWithoutTemperature, TakesHeatThatIsCounted) {
  const Host host;
  const ThermalContact thermal(host.contact, host.on_slave_alone(), host.fixture.dofs, {{0, {}, {}, 0.3}});
  const ContactHeat heat = thermal.evaluate(*host.laws, *host.x, 0.1);
  const HeatFlow flow = heat.flow(0);
  EXPECT_NE(flow.friction, 0.0);
  EXPECT_NEAR(flow.to_master_without_rows, 0.7 * flow.friction, 1e-13 * std::abs(flow.friction));
  EXPECT_EQ(flow.to_slave_without_rows, 0.0);
  EXPECT_EQ(flow.conducted, 0.0);
  Vector r(host.fixture.dofs), ones(host.fixture.dofs);
  heat.add_to(r);
  ones.putScalar(1.0);
  EXPECT_NEAR(r.dot(ones), -0.3 * flow.friction, 1e-13 * std::abs(flow.friction));
}

// Temperatures that the host has eliminated conduct all the same.
TEST(BodyWithoutTemperature, ConductsWithTemperaturesThatAreGiven) {
  const Host host;
  const ThermalContact with_rows = host.thermal({0, constant(2.0), {}, {}});
  const ThermalContact without(host.contact, host.on_slave_alone(), host.fixture.dofs, {{0, constant(2.0), {}, {}}});
  EXPECT_THROW(without.evaluate(*host.laws, *host.x, 0.0), std::invalid_argument);
  Vector of_nodes(host.fixture.nodes);
  for (const GlobalOrdinal node : local_ids(*host.fixture.nodes)) {
    const LocalOrdinal row = host.fixture.dofs->getLocalElement(host.fixture.scalar_field().id(host.fixture.nodes->getLocalElement(node), 0));
    of_nodes.replaceGlobalValue(node, host.x->getData()[row]);
  }
  const HeatFlow expected = with_rows.evaluate(*host.laws, *host.x, 0.0).flow(0),
                 flow = without.evaluate(*host.laws, {*host.x, of_nodes}, 0.0).flow(0);
  EXPECT_NE(flow.conducted, 0.0);
  EXPECT_NEAR(flow.conducted, expected.conducted, 1e-13 * std::abs(expected.conducted));
  EXPECT_NEAR(flow.to_master_without_rows, flow.conducted, 1e-13 * std::abs(flow.conducted));
}

TEST(HeatAcrossContact, RefusesWhatDoesNotFit) {
  const Host host;
  EXPECT_THROW(host.thermal({3, constant(1.0), {}, {}}), std::out_of_range);
  EXPECT_THROW(host.thermal({0, constant(-1.0), {}, {}}), std::invalid_argument);
  EXPECT_THROW(host.thermal({0, constant(1.0), {}, 1.1}), std::invalid_argument);
  EXPECT_THROW(host.thermal({0, constant(1.0), {}, -0.1}), std::invalid_argument);
  EXPECT_THROW(ThermalContact(host.contact, host.fixture.scalar_field(), host.fixture.dofs, {{0, constant(1.0), {}, {}}, {0, constant(1.0), {}, {}}}),
               std::invalid_argument);
  EXPECT_THROW(host.thermal({0, {}, {}, 0.5}).evaluate(*host.laws, *host.x, 0.0), std::invalid_argument);
  EXPECT_NO_THROW(host.thermal({0, constant(1.0), {}, {}}).evaluate(*host.laws, *host.x, 0.0));
  const Vector elsewhere(host.contact.multiplier_map());
  EXPECT_THROW(host.thermal({0, constant(1.0), {}, {}}).evaluate(*host.laws, elsewhere, 0.0), std::invalid_argument);
}

TEST(HeatAcrossContact, FailsWhereAConductanceIsNone) {
  const Host host;
  const auto evaluated = [&](const ScalarFunction::Body& h) { host.thermal({0, function(h), {}, {}}).evaluate(*host.laws, *host.x, 0.0); };
  EXPECT_THROW(evaluated([](const std::vector<double>&) { return -1.0; }), StepFailure);
  EXPECT_THROW(evaluated([](const std::vector<double>&) { return std::nan(""); }), StepFailure);
  // On one rank alone: the other one does not wait.
  EXPECT_THROW(evaluated([](const std::vector<double>&) -> double {
                 if (Tpetra::getDefaultComm()->getRank() == 0) throw std::runtime_error("no value");
                 return 1.0;
               }),
               StepFailure);
  EXPECT_NO_THROW(evaluated([](const std::vector<double>&) { return 1.0; }));
}

// The graph of a contact system that does not know of the temperature has no place for its rows.
TEST(HeatAcrossContact, NeedsPlaceInTheGraph) {
  for (const bool transfers : {true, false}) {
    const Host host(transfers);
    const ContactLinearisation linearised = host.at->linearise(*host.laws);
    const DifferentiatedHeat heat = host.thermal({0, constant(1.0), {}, {}}).differentiate(linearised, *host.x, 0.0);
    const RCP<Matrix> A = host.fixture.springs(host.contact.graph(*host.at, [&] { return host.fixture.bulk; }));
    Vector rhs(host.fixture.dofs);
    const NodeElimination condensed = linearised.condense(*A, rhs);
    bool refused = false;
    try {
      heat.condense(condensed, *A, rhs);
    } catch (const std::logic_error&) {
      refused = true;
    }
    EXPECT_EQ(most_over_ranks(*host.fixture.dofs->getComm(), refused ? 1 : 0) != 0, !transfers);
  }
}

}  // namespace
}  // namespace mortise
