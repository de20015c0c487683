// The initial guess of a step: which nodes start closed.

#include <gtest/gtest.h>

#include "formulations.hpp"
#include "mortise/contact/holding_nodes.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::TwoSurfaces;

/// With dual mortar and with each other formulation.
class StartRule : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(All, StartRule, ::testing::Range(-1, static_cast<int>(test::other_formulations().size())));

/// Places of all nodes. The body of a node does not matter here: the slave is body 0, the master body 1.
MultiVector places_of(const Fixture& fixture, const TwoSurfaces& surfaces) {
  MultiVector places(fixture.nodes, static_cast<std::size_t>(1 + surfaces.dimension));
  for (std::size_t n = 0; n < local_id_count(*fixture.nodes); ++n)
    places.replaceLocalValue(
        static_cast<LocalOrdinal>(n), 0,
        fixture.nodes->getGlobalElement(static_cast<LocalOrdinal>(n)) < static_cast<GlobalOrdinal>(surfaces.slave.size()) ? 0 : 1);
  return places;
}

int sum_over_ranks(const Fixture& fixture, int mine) {
  int all = 0;
  Teuchos::reduceAll(*fixture.nodes->getComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

TwoSurfaces five_nodes_over_three_facets() {
  TwoSurfaces flat;
  for (int i = 0; i < 5; ++i) flat.slave.push_back({1.0 * i, 0.0, 0.0});
  for (int i = 0; i < 4; ++i) flat.master.push_back({4.0 * (3 - i) / 3.0, 0.0, 0.0});
  flat.fixed.assign(flat.size(), {});
  return flat;
}

// A node that touches starts closed. One that stands apart does not, until it is asked for: then it is closed, however far it is.
TEST_P(StartRule, ClosesNodesThatTouchAndThoseThatAreGuessedTo) {
  TwoSurfaces flat = five_nodes_over_three_facets();
  if (GetParam() >= 0) flat.options.formulation.options = test::other_formulations()[GetParam()].options;
  Fixture fixture(flat, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  const auto lifted = [&](double by) { return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return id < 10 && id % 2 == 1 ? by : 0.0; }); };
  const MultiVector places = places_of(fixture, flat);
  for (const double by : {0.0, 0.05, 0.3}) {
    SCOPED_TRACE(by);
    const RCP<Vector> d = lifted(by);
    Vector z(contact.multiplier_map());
    const ContactHistory history = contact.start_step(contact.initial_history(*d), *d, z);
    const DifferentiatedContact at = contact.differentiate(*d, history);
    const ContactLaws laws = at.laws(z);
    EXPECT_EQ(laws.norms(history->states).active, by == 0.0 ? 5 : 0);

    const auto near = bearing_nodes(laws, places), covered = bearing_nodes(laws, places, OpenNodes::covered);
    EXPECT_EQ(sum_over_ranks(fixture, static_cast<int>(near.size())), by < 0.1 ? 5 : 0);
    EXPECT_EQ(sum_over_ranks(fixture, static_cast<int>(covered.size())), 5);
    Vector guess(z, Teuchos::Copy);
    for (const BearingNode& node : covered) {
      EXPECT_EQ(node.closed, by == 0.0);
      EXPECT_NEAR(node.gap, by, 1e-14);
      EXPECT_NEAR(node.near, 0.1, 1e-14);
      guess_closed(laws, node, guess);
    }
    EXPECT_EQ(at.laws(guess).norms(history->states).active, 5);
  }
}

// Surfaces that touch bear nothing yet; what is guessed to be closed bears pressure.
TEST(StartRuleOfPressureLaws, GapsAreThoseToWhereThePressureBegins) {
  const auto table = std::make_shared<TabulatedPressure>();
  table->overclosures = {0.1, 0.2};
  table->pressures = {0.0, 10.0};
  const auto formulation = std::make_shared<PressureOverclosure>();
  formulation->law.options = table;
  TwoSurfaces flat = five_nodes_over_three_facets();
  flat.options.formulation.options = formulation;
  Fixture fixture(flat, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  Vector d(fixture.dofs), z(contact.multiplier_map());
  const ContactHistory history = contact.start_step(contact.initial_history(d), d, z);
  const DifferentiatedContact at = contact.differentiate(d, history);
  const ContactLaws laws = at.laws(z);
  EXPECT_EQ(laws.norms(history->states).active, 0);
  for (const BearingNode& node : bearing_nodes(laws, places_of(fixture, flat), OpenNodes::covered)) {
    EXPECT_NEAR(node.gap, 0.1, 1e-14);
    guess_closed(laws, node, z);
  }
  EXPECT_EQ(at.laws(z).norms(history->states).active, 5);
}

/// A flat slave of squares, 4 x 4 nodes at unit distance; in 2D one row of 6 nodes. The master, at height 0, ends at x = `end`.
TwoSurfaces flat_up_to(double end, bool space) {
  TwoSurfaces flat = space ? test::dome_on_waves() : TwoSurfaces();
  if (!space) {
    for (int i = 0; i < 6; ++i) flat.slave.push_back({1.0 * i, 0.0, 0.0});
    for (int i = 0; i < 3; ++i) flat.master.push_back({end * (1.0 - i / 2.0) - 1.0 * (i == 2), 0.0, 0.0});
    flat.fixed.assign(flat.size(), {});
    return flat;
  }
  for (std::size_t n = 0; n < flat.slave.size(); ++n) flat.slave[n] = {1.0 * (n % 4), 1.0 * static_cast<double>(n / 4), 0.0};
  for (std::size_t n = 0; n < flat.master.size(); ++n)
    flat.master[n] = {-1.0 + (end + 1.0) * static_cast<double>(n % 5) / 4.0, -1.0 + 5.0 * static_cast<double>(n / 5) / 3.0, 0.0};
  return flat;
}

// The slave comes to stand over the master by a tenth of a facet more. Under an even pressure p the nodes that begin to be covered take p: then
// nothing of a condition changes. In 3D they are tied to one another as well: sweeps end where one changes less than 1e-8 of p. Each node that is new
// has a share of less than (c' + eta C) / C = 0.063 in the others, with c' / C = 0.05 / 0.95 and eta = 0.01.
TEST(FollowCover, StartsWhatBeginsToBeCoveredWithTheMeanOfItsNeighbours) {
  for (const bool space : {false, true}) {
    const TwoSurfaces flat = flat_up_to(space ? 1.9 : 2.9, space);
    const int dim = flat.dimension;
    const GlobalOrdinal edge = space ? 3 : 4;  // of the nodes that begin to be covered the first
    Fixture fixture(flat, Tpetra::getDefaultComm());
    const auto slave_dofs = static_cast<GlobalOrdinal>(flat.slave.size()) * dim, offset = fixture.dofs->getMaxAllGlobalIndex() + 1;
    const auto moved = [&](double along, double up) {
      return Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) {
        return id >= slave_dofs ? 0.0 : id % dim == 0 ? along : id % dim == dim - 1 ? up : 0.0;
      });
    };
    const auto is_new = [&](GlobalOrdinal id) { return space ? ((id - offset) / dim) % 4 == 3 : (id - offset) / dim == edge; };
    const double p = 3.0;
    const auto even = [&](bool with_new) {
      return Fixture::vector(fixture.contact->multiplier_map(), [&](GlobalOrdinal id) {
        const bool covered = space || (id - offset) / dim <= edge;
        return (id - offset) % dim == dim - 1 && covered && (with_new || !is_new(id)) ? -p : 0.0;
      });
    };
    const RCP<Vector> z = even(false), expected = even(true);
    const auto off = [&] {
      Vector difference(*z, Teuchos::Copy);
      difference.update(-1.0, *expected, 1.0);
      return difference.normInf();
    };
    const ContactSystem& contact = *fixture.contact;
    const ContactHistory history = fixture.first_step(*moved(0.0, 0.0), *z);
    DifferentiatedContact at = contact.differentiate(*moved(0.0, 0.0), history);
    ContactStates last = at.laws(*z).states();
    EXPECT_FALSE(at.follow_cover(last, *z));

    at = contact.differentiate(*moved(-0.2, 0.0), history, &last);
    EXPECT_TRUE(at.follow_cover(last, *z));
    EXPECT_LE(off(), 1e-8 * p);
    Vector C(contact.multiplier_map());
    at.laws(*expected).complementarity(C);
    EXPECT_LE(C.normInf(), 1e-13 * 1000.0);

    // From the next iterate on it is Newton's to say.
    last = at.laws(*z).states();
    z->scale(2.0);
    EXPECT_FALSE(at.follow_cover(last, *z));
    EXPECT_NEAR(z->normInf(), 2.0 * p, 1e-3 * p);

    // A node that is not covered any more has none.
    at = contact.differentiate(*moved(0.0, 0.0), history, &last);
    EXPECT_TRUE(at.follow_cover(last, *z));
    z->scale(0.5);
    z->update(1.0, *expected, -1.0);
    EXPECT_NEAR(z->normInf(), p, 1e-14 * p);  // at the nodes of the edge alone

    // A node that is to open does not start closed.
    last = at.laws(*z).states();
    z->assign(*even(false));
    contact.differentiate(*moved(-0.2, 100.0), history, &last).follow_cover(last, *z);
    const auto view = z->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t k = 0; k < view.extent(0); ++k)
      if (is_new(contact.multiplier_map()->getGlobalElement(static_cast<LocalOrdinal>(k)))) EXPECT_EQ(view(k, 0), 0.0);
  }
}

// Without ties multipliers are Newton's alone.
TEST(FollowCover, LeavesAlonePairsWithoutTies) {
  TwoSurfaces flat = flat_up_to(2.9, false);
  flat.options.full_cover = 0.0;
  Fixture fixture(flat, Tpetra::getDefaultComm());
  Vector d(fixture.dofs), z(fixture.contact->multiplier_map());
  const ContactHistory history = fixture.first_step(d, z);
  z.putScalar(1.0);
  EXPECT_FALSE(fixture.contact->evaluate(d, history).follow_cover(history->states, z));
  EXPECT_EQ(z.normInf(), 1.0);
}

}  // namespace
}  // namespace mortise
