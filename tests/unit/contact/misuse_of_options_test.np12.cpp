// Options, numbers and facets of a host that are wrong, or differ between ranks, refused on every rank.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "misuse_host.hpp"
#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/contact/friction.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Host;
using test::thrown;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

std::string with_coefficient(const ScalarFunction& coefficient) {
  Host host;
  const auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = coefficient;
  host.pair.options.friction = {"coulomb", coulomb, {}};
  return host.refused<InputError>();
}

TEST(MisuseOfOptions, NumbersOutOfRange) {
  EXPECT_EQ(with_coefficient(0.0), "");
  for (const double coefficient : {nan, -0.2, infinite})
    EXPECT_THAT(with_coefficient(coefficient),
                AllOf(HasSubstr("contact/joint: \"friction/coefficient\" is"), HasSubstr("allowed: finite numbers >= 0")));
  for (const double cover : {2.0, -3.0, nan}) {
    Host host;
    host.pair.options.full_cover = cover;
    EXPECT_THAT(host.refused<InputError>(), HasSubstr("\"full cover\" is")) << cover;
  }
  for (const double reach : {0.0, -1.0, nan}) {
    Host host;
    host.pair.options.mortar.search_reach = reach;
    EXPECT_THAT(host.refused<InputError>(), HasSubstr("\"search reach\" is")) << reach;
  }
  Host stiff;
  const auto penalty = std::make_shared<Penalty>();
  penalty->normal = -1.0;
  stiff.pair.options.formulation = {"penalty", penalty, {}};
  EXPECT_THAT(stiff.refused<InputError>(), HasSubstr("\"formulation/stiffness\" is -1"));
}

TEST(MisuseOfOptions, RanksThatDiffer) {
  if (Tpetra::getDefaultComm()->getSize() == 1) return;
  const bool first = Tpetra::getDefaultComm()->getRank() == 0;
  const auto refused = [&](const std::function<void(ContactPair&)>& spoil) {
    Host host;
    if (first) spoil(host.pair);
    return host.refused<InputError>();
  };
  const auto differs = HasSubstr("name, Young's modulus or options of pair 0 differ between ranks");
  EXPECT_THAT(refused([](ContactPair& pair) { pair.youngs_modulus = 2.0; }), differs);
  EXPECT_THAT(refused([](ContactPair& pair) { pair.name = "other"; }), differs);
  EXPECT_THAT(refused([](ContactPair& pair) { pair.options.full_cover = 0.5; }), differs);
  EXPECT_THAT(refused([](ContactPair& pair) { pair.options.mortar.search_reach = 0.7; }), differs);
  EXPECT_THAT(refused([](ContactPair& pair) { pair.options.friction = {"coulomb", std::make_shared<CoulombFriction>(), {}}; }), differs);
  EXPECT_THAT(refused([](ContactPair& pair) {
                pair.options.formulation = {"augmented lagrange", std::make_shared<AugmentedLagrange>(), {}};
              }),
              differs);
  Host host;
  std::vector<ContactPair> pairs{host.pair};
  if (first) pairs.clear();
  const auto made = [&] { ContactSystem(host.nodes, host.dofs, host.reference, host.fixed, {}, pairs, Timers()); };
  EXPECT_THAT(thrown<InputError>(made), HasSubstr("contact pairs are given on rank"));
}

TEST(MisuseOfOptions, SecondPassesOfNoPair) {
  for (const std::size_t of : {std::size_t{0}, std::size_t{3}}) {
    Host host;
    host.pair.second_pass_of = of;
    EXPECT_THAT(host.refused<InputError>(), HasSubstr("give the number of an earlier pair"));
  }
}

TEST(MisuseOfOptions, FacetsThatAreNeedlessOrTwice) {
  Host twice;
  if (!twice.pair.slave.empty()) twice.pair.slave.push_back({1, 0});
  EXPECT_THAT(twice.refused<InputError>(), HasSubstr("the slave facet of nodes 1, 0 is given twice on rank"));
  Host negative;
  if (!negative.pair.master.empty()) negative.pair.master = {{2, -3}};
  EXPECT_THAT(negative.refused<InputError>(), HasSubstr("a facet of the master names node -3"));
  Host gaps;
  gaps.pair.facet_gaps = std::make_shared<std::vector<double>>(3, 0.0);
  EXPECT_THAT(gaps.refused<InputError>(), HasSubstr("`facet_gaps` has 3 entries on rank"));
}

/// Facet 0-1 of nodes of rank 0, given on rank 1 too.
TEST(MisuseOfOptions, SlaveFacetsOnRanksThatOwnNoneOfTheirNodes) {
  const RCP<const Communicator> comm = Tpetra::getDefaultComm();
  if (comm->getSize() == 1) return;
  std::vector<GlobalOrdinal> ids;
  if (comm->getRank() < 2) ids = {2 * comm->getRank(), 2 * comm->getRank() + 1};
  Host host;
  host.nodes = rcp(new Map(4, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
  host.dofs = make_dof_map(*host.nodes, 2);
  host.reference = rcp(new MultiVector(host.nodes, 2)), host.fixed = rcp(new MultiVector(host.nodes, 2));
  for (const GlobalOrdinal node : ids) host.reference->replaceGlobalValue(node, 0, node == 1 || node == 2 ? 1.0 : 0.0);
  host.pair.slave = {{0, 1}};
  host.pair.master.clear();
  if (comm->getRank() == 1) host.pair.master = {{2, 3}};
  EXPECT_THAT(host.refused<InputError>(), HasSubstr("the slave facet of nodes 0, 1 is given on rank 1, which owns none of them"));
  if (comm->getRank() != 0) host.pair.slave.clear();
  EXPECT_EQ(host.refused<InputError>(), "");
}

TEST(MisuseOfOptions, FieldsThatAreMissingOrNoNumbers) {
  for (RCP<MultiVector> Host::*field : {&Host::reference, &Host::fixed}) {
    Host host;
    host.*field = Teuchos::null;
    EXPECT_THAT(host.refused<std::invalid_argument>(), HasSubstr("is null"));
  }
  Host without_rows;
  without_rows.dofs = Teuchos::null;
  EXPECT_THAT(without_rows.refused<std::invalid_argument>(), HasSubstr("`dofs` is null"));
  Host unplaced;
  if (unplaced.nodes->isNodeGlobalElement(3)) unplaced.reference->replaceGlobalValue(3, 1, nan);
  EXPECT_NE(unplaced.refused<std::invalid_argument>(), "");
  Host marked;
  if (marked.nodes->isNodeGlobalElement(3)) marked.fixed->replaceGlobalValue(3, 1, 5.0);
  EXPECT_NE(marked.refused<std::invalid_argument>(), "");
  Host shared;
  std::vector<GlobalOrdinal> rows;
  for (const GlobalOrdinal node : local_ids(*shared.nodes)) rows.insert(rows.end(), {2 * node, node == 1 ? 2 * node : 2 * node + 1});
  const auto made = [&] {
    ContactSystem(NodalField("displacement", shared.nodes, 2, rows), shared.dofs, shared.reference, shared.fixed, {}, {shared.pair}, Timers());
  };
  EXPECT_NE(thrown<std::invalid_argument>(made), "");
  EXPECT_THAT(thrown<std::invalid_argument>([] { ScalarFunction(ScalarFunction::Body{}, "mu"); }), HasSubstr("the function \"mu\" has no body"));
}

TEST(MisuseOfOptions, DepthsAndSharesOutOfRange) {
  Host host;
  const ContactSystem contact(host.nodes, host.dofs, host.reference, host.fixed, {}, {host.pair}, Timers());
  const ContactHistory history = contact.initial_history(Vector(host.dofs));
  for (const double depth : {-1.0, nan, infinite})
    EXPECT_THAT(thrown<std::invalid_argument>([&] { contact.allow_overlap(history, 0, depth); }), HasSubstr("`depth` is"));
  for (const double share : {0.0, -1.0, nan})
    EXPECT_THAT(thrown<std::invalid_argument>([&] { contact.weigh_gaps(history, share); }), HasSubstr("`share` is"));
}

/// A node that is on no surface.
TEST(MisuseOfOptions, DisplacementsThatAreNoNumbersAwayFromContact) {
  const auto failure = [](double value) {
    const RCP<const Communicator> comm = Tpetra::getDefaultComm();
    Host host;
    const auto own = local_ids(*host.nodes);
    std::vector<GlobalOrdinal> ids(own.begin(), own.end());
    if (comm->getRank() == 0) ids.push_back(4);
    host.nodes = rcp(new Map(5, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
    host.dofs = make_dof_map(*host.nodes, 2);
    const auto reference = rcp(new MultiVector(host.nodes, 2));
    for (const GlobalOrdinal node : ids) reference->replaceGlobalValue(node, 0, node == 1 || node == 2 ? 1.0 : 0.0);
    const ContactSystem contact(host.nodes, host.dofs, reference, rcp(new MultiVector(host.nodes, 2)), {}, {host.pair}, Timers());
    Vector d(host.dofs);
    const ContactHistory history = contact.initial_history(d);
    if (comm->getRank() == 0) d.replaceGlobalValue(8, value);
    return thrown<StepFailure>([&] { contact.evaluate(d, history); });
  };
  EXPECT_EQ(failure(1.0), "");
  EXPECT_NE(failure(nan), "");
}

/// The surfaces lie on one another: nodes are closed at any pressure.
TEST(MisuseOfOptions, CoefficientsWithoutValueFailTheStepOnEveryRank) {
  const auto failure = [](const ScalarFunction::Body& body) {
    Host host;
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(body, "of the host");
    host.pair.options.friction = {"coulomb", coulomb, {}};
    const ContactSystem contact(host.nodes, host.dofs, host.reference, host.fixed, {}, {host.pair}, Timers());
    Vector d(host.dofs), z(contact.multiplier_map());
    const ContactHistory history = contact.initial_history(d);
    for (const GlobalOrdinal id : local_ids(*contact.multiplier_map()))
      if (id % 2 == 1) z.replaceGlobalValue(id, -1.0);
    const DifferentiatedContact at = contact.differentiate(d, history);
    return thrown<StepFailure>([&] { at.linearise(at.laws(z)); });
  };
  EXPECT_EQ(failure([](const std::vector<double>&) { return 0.3; }), "");
  EXPECT_THAT(failure([](const std::vector<double>&) { return nan; }), HasSubstr("\"of the host\" is nan at pressure = 1"));
  EXPECT_THAT(failure([](const std::vector<double>&) { return -1.0; }), HasSubstr("allowed: >= 0 and finite"));
  EXPECT_THAT(failure([](const std::vector<double>&) -> double {
                if (Tpetra::getDefaultComm()->getRank() == 0) throw std::runtime_error("table is empty");
                return 0.3;
              }),
              HasSubstr("(table is empty)"));
}

}  // namespace
}  // namespace mortise
