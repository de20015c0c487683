// What mortise.h gives is what ContactSystem gives, bit by bit.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "mortise/contact/contact_report.hpp"
#include "mortise/contact/formulation/augmented_lagrange.hpp"
#include "mortise/contact/formulation/penalty.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "plain_host.hpp"

namespace mortise {
namespace {

using namespace test;

double wiggle(GlobalOrdinal id) { return std::sin(2.7 * static_cast<double>(id) + 0.4); }

/// Options as a struct, and as a host writes them.
struct PlainCase {
  std::string name;
  TwoSurfaces surfaces;
  std::string options;
  HostNumbering numbering = HostNumbering::by_nodes;
};

std::vector<PlainCase> cases() {
  const auto with_friction = [](TwoSurfaces surfaces) {
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(0.3);
    surfaces.options.friction = {"coulomb", coulomb, {}};
    return surfaces;
  };
  const std::string friction = "friction/type = coulomb; friction/coefficient = 0.3";
  std::vector<PlainCase> all;
  all.push_back({"Friction", with_friction(arch_on_ground()), friction});
  all.push_back({"Space", with_friction(dome_on_waves()), friction});
  all.push_back({"HardlyCovered", with_friction(hardly_covered(dome_on_waves())), friction});
  TwoSurfaces held = with_friction(arch_on_ground());
  held.fixed[0] = {true, true, false};
  held.fixed[8][1] = true;
  all.push_back({"OwnNumbering", held, friction, HostNumbering::interleaved});
  TwoSurfaces penalty = arch_on_ground();
  const auto stiff = std::make_shared<Penalty>();
  stiff->normal = 4.0;
  penalty.options.formulation = {"penalty", stiff, {}};
  all.push_back({"Penalty", penalty, "formulation/type = penalty\nformulation/stiffness = 4"});
  TwoSurfaces kept = arch_on_ground();
  kept.options.formulation = {"standard mortar", std::make_shared<StandardMortar>(), {}};
  all.push_back({"Kept", kept, "formulation/type = standard mortar"});
  TwoSurfaces apart = arch_on_ground();
  apart.options.clearance = ScalarFunction(-0.01);
  apart.options.mortar.gauss_points = 7;
  all.push_back({"Clearance", apart, "clearance = -0.01; gauss points = 7"});
  return all;
}

class SameValues : public ::testing::TestWithParam<std::size_t> {};

TEST_P(SameValues, InAStep) {
  const PlainCase one = cases()[GetParam()];
  const Fixture fixture(one.surfaces, Tpetra::getDefaultComm(), one.numbering);
  const ContactSystem& contact = *fixture.contact;
  PlainHost host(PlainArrays(one.surfaces, fixture));
  host.set_up(one.options);
  const std::int64_t rows = host.rows, multipliers = host.multipliers;
  ASSERT_EQ(multipliers, static_cast<std::int64_t>(local_id_count(*contact.multiplier_map())));

  std::vector<std::int64_t> ids(static_cast<std::size_t>(multipliers));
  std::vector<double> weights(ids.size());
  ASSERT_EQ(mortise_multipliers(host.contact, multipliers, ids.data(), nullptr, weights.data()), MORTISE_OK);
  for (std::size_t k = 0; k < ids.size(); ++k) EXPECT_EQ(ids[k], contact.multiplier_map()->getGlobalElement(static_cast<LocalOrdinal>(k)));
  EXPECT_EQ(weights, entries(*contact.weights()));

  // Displacements of what is prescribed and no unknown.
  MultiVector elsewhere(fixture.nodes, static_cast<std::size_t>(one.surfaces.dimension));
  std::vector<double> prescribed;
  for (const GlobalOrdinal node : local_ids(*fixture.nodes))
    for (int i = 0; i < one.surfaces.dimension; ++i) {
      prescribed.push_back(0.003 * wiggle(one.surfaces.dimension * node + i));
      elsewhere.replaceGlobalValue(node, static_cast<std::size_t>(i), prescribed.back());
    }

  const auto before = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.005 * wiggle(id + 3); });
  const auto at = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const std::vector<double> d_before = entries(*before), d = entries(*at);
  const auto n = static_cast<std::size_t>(rows), m = static_cast<std::size_t>(multipliers);

  Vector guess(contact.multiplier_map());
  const ContactHistory first = contact.with_clearances(contact.initial_history(NodalDisplacement(*before, elsewhere)), 0.0);
  const ContactHistory history = contact.start_step(first, NodalDisplacement(*before, elsewhere), guess);
  std::vector<double> z_start(m, 0.0);
  ASSERT_EQ(mortise_start_step(host.contact, rows, multipliers, d_before.data(), prescribed.data(), z_start.data()), MORTISE_OK) << host.error();
  EXPECT_EQ(z_start, entries(guess));

  const auto z = fixture.multipliers([](std::size_t node) { return node % 3 == 0 ? 0.0 : 2.0 + 0.3 * static_cast<double>(node); });
  const std::vector<double> z_here = entries(*z);
  const NodalDisplacement here(*at, elsewhere);
  ContactStates last = history->states;
  const DifferentiatedContact differentiated = contact.differentiate(here, history, &last);
  const ContactLaws laws = differentiated.laws(*z), without_derivatives = contact.evaluate(here, history).laws(*z);

  std::vector<double> f(n), C(m);
  mortise_norms plain{};
  for (const bool derivatives : {false, true, false, true}) {
    Vector force(fixture.dofs), conditions(contact.multiplier_map());
    const ContactLaws& expected = derivatives ? laws : without_derivatives;
    expected.add_force(force);
    expected.complementarity(conditions);
    const ContactNorms norms = expected.norms(last);
    std::fill(f.begin(), f.end(), 7.0);
    const auto evaluate = derivatives ? mortise_differentiate : mortise_evaluate;
    ASSERT_EQ(evaluate(host.contact, rows, multipliers, d.data(), prescribed.data(), z_here.data(), f.data(), C.data(), &plain), MORTISE_OK)
        << host.error();
    EXPECT_EQ(f, entries(force));
    EXPECT_EQ(C, entries(conditions));
    EXPECT_EQ(plain.gap, norms.gap);
    EXPECT_EQ(plain.complementarity, norms.complementarity);
    EXPECT_EQ(plain.force, norms.force);
    EXPECT_EQ(plain.active, norms.active);
    EXPECT_EQ(plain.sticking, norms.sticking);
    EXPECT_EQ(plain.changed, norms.changed);
  }

  // The blocks, before and after condense() and in between.
  const ContactLinearisation linearised = differentiated.linearise(laws);
  const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
  const auto expect_blocks = [&] {
    mortise_matrix matrix{};
    const std::pair<mortise_block, const Matrix*> all[] = {
        {MORTISE_F_Z, blocks.B.get()}, {MORTISE_C_D, blocks.C_d.get()}, {MORTISE_C_Z, blocks.C_z.get()}};
    for (const auto& [block, expected] : all) {
      ASSERT_EQ(mortise_jacobian(host.contact, block, &matrix), MORTISE_OK) << host.error();
      EXPECT_TRUE(Compressed(matrix) == Compressed(*expected)) << "block " << block;
    }
    ASSERT_EQ(mortise_jacobian(host.contact, MORTISE_F_D, &matrix), MORTISE_OK) << host.error();
    const Compressed stiffness(matrix);
    const RCP<const Graph> graph = contact.graph(differentiated, [&] { return fixture.bulk; });
    const RCP<Matrix> with = fixture.springs(graph), without = fixture.springs(graph);
    linearised.add_stiffness(*with);
    double largest = 0.0;
    for (std::int64_t row = 0; row < rows; ++row) {
      Matrix::local_inds_host_view_type columns;
      Matrix::values_host_view_type added, springs;
      with->getLocalRowView(static_cast<LocalOrdinal>(row), columns, added);
      without->getLocalRowView(static_cast<LocalOrdinal>(row), columns, springs);
      for (std::size_t k = 0; k < columns.extent(0); ++k) {
        double value = springs(k) - added(k);
        for (std::int64_t e = stiffness.starts[row]; e < stiffness.starts[row + 1]; ++e)
          if (stiffness.columns[e] == with->getColMap()->getGlobalElement(columns(k))) value += stiffness.values[e];
        largest = std::max(largest, std::abs(value));
      }
    }
    EXPECT_LE(largest, 1e-12);
  };
  expect_blocks();
  ASSERT_EQ(mortise_evaluate(host.contact, rows, multipliers, d.data(), prescribed.data(), z_here.data(), nullptr, nullptr, &plain), MORTISE_OK);
  EXPECT_EQ(plain.changed, 0) << "the states of the last linearised iterate";

  const RCP<Matrix> bulk = fixture.springs(fixture.bulk);
  bulk->fillComplete(fixture.dofs, fixture.dofs);
  const Compressed K(*bulk);
  const auto right = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 5.0 * wiggle(7 * id + 3); });
  mortise_matrix matrix{};
  if (contact.keeps_multipliers()) {
    std::vector<double> rhs = entries(*right);
    EXPECT_EQ(mortise_condense(host.contact, rows, K.starts.data(), K.columns.data(), K.values.data(), rhs.data(), &matrix), MORTISE_REFUSED);
    return;
  }
  const RCP<Matrix> system = fixture.springs(contact.graph(
      differentiated, [&] { return fixture.bulk; }, 1));
  linearised.add_stiffness(*system);
  Vector condensed_right(*right, Teuchos::Copy);
  const NodeElimination elimination = linearised.condense(*system, condensed_right);
  std::vector<double> rhs;
  for (int time = 0; time < 3; ++time) {
    rhs = entries(*right);
    ASSERT_EQ(mortise_condense(host.contact, rows, K.starts.data(), K.columns.data(), K.values.data(), rhs.data(), &matrix), MORTISE_OK)
        << host.error();
    EXPECT_TRUE(Compressed(matrix) == Compressed(*system)) << time;
    EXPECT_EQ(rhs, entries(condensed_right));
    if (time == 1) expect_blocks();
  }

  // A solver that is none: half of the right-hand side. Whatever it is, both ask it the same.
  struct Halves {
    static int solve(void* calls, std::int64_t size, const double* b, double* x) {
      ++*static_cast<int*>(calls);
      for (std::int64_t i = 0; i < size; ++i) x[i] = 1e-4 * b[i];
      return 0;
    }
  };
  int calls = 0, plain_calls = 0;
  Vector dd(fixture.dofs), dz(contact.multiplier_map());
  elimination.solve(
      condensed_right,
      [&](const Vector& b, Vector& x) {
        ++calls;
        x.update(1e-4, b, 0.0);
      },
      dd, dz);
  std::vector<double> plain_dd(n), plain_dz(m), plain_z(m);
  ASSERT_EQ(mortise_solve(host.contact, rows, multipliers, rhs.data(), &Halves::solve, &plain_calls, plain_dd.data(), plain_dz.data()), MORTISE_OK)
      << host.error();
  EXPECT_EQ(plain_calls, calls);
  EXPECT_EQ(plain_dd, entries(dd));
  EXPECT_EQ(plain_dz, entries(dz));
  Vector recovered(contact.multiplier_map());
  elimination.recover(dd, recovered);
  ASSERT_EQ(mortise_recover(host.contact, rows, multipliers, plain_dd.data(), plain_z.data()), MORTISE_OK) << host.error();
  EXPECT_EQ(plain_z, entries(recovered));

  // The next step starts from what was accepted, in a second system from what was stored.
  ASSERT_EQ(mortise_differentiate(host.contact, rows, multipliers, d.data(), prescribed.data(), z_here.data(), nullptr, nullptr, nullptr),
            MORTISE_OK);
  const ContactHistory next = contact.commit(laws);
  ASSERT_EQ(mortise_accept(host.contact), MORTISE_OK) << host.error();
  std::int64_t count = 0, size = 0;
  ASSERT_EQ(mortise_count_nodes(host.contact, 0, &count), MORTISE_OK);
  std::vector<mortise_node> report(static_cast<std::size_t>(count));
  ASSERT_EQ(mortise_report(host.contact, 0, count, report.data()), MORTISE_OK) << host.error();
  const std::vector<ContactNodeState> states = node_states(laws, 0);
  ASSERT_EQ(states.size(), report.size());
  for (std::size_t k = 0; k < report.size(); ++k) {
    EXPECT_EQ(report[k].node, states[k].node);
    EXPECT_EQ(report[k].state, static_cast<int>(states[k].state));
    EXPECT_EQ(report[k].gap, states[k].gap);
    EXPECT_EQ(report[k].pressure, states[k].pressure);
    EXPECT_EQ(report[k].slip_path, states[k].slip_path);
  }
  ASSERT_EQ(mortise_store(host.contact, 0, nullptr, &size), MORTISE_OK) << host.error();
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  ASSERT_EQ(mortise_store(host.contact, size, bytes.data(), &size), MORTISE_OK) << host.error();
  PlainHost again(PlainArrays(one.surfaces, fixture));
  again.set_up(one.options);
  ASSERT_EQ(mortise_restore(again.contact, size, bytes.data(), rows, multipliers, d.data(), prescribed.data(), z_here.data()), MORTISE_OK)
      << again.error();

  Vector next_guess(*z, Teuchos::Copy);
  const ContactHistory next_step = contact.start_step(contact.with_clearances(next, 0.0), here, next_guess);
  const ContactLaws next_laws = contact.evaluate(NodalDisplacement(*before, elsewhere), next_step).laws(*z);
  Vector next_C(contact.multiplier_map());
  next_laws.complementarity(next_C);
  for (mortise_contact* one_of : {host.contact, again.contact, host.contact}) {
    std::vector<double> z_next = z_here;
    ASSERT_EQ(mortise_start_step(one_of, rows, multipliers, d.data(), prescribed.data(), z_next.data()), MORTISE_OK) << mortise_last_error(one_of);
    EXPECT_EQ(z_next, entries(next_guess));
    ASSERT_EQ(mortise_evaluate(one_of, rows, multipliers, d_before.data(), prescribed.data(), z_here.data(), nullptr, C.data(), nullptr), MORTISE_OK)
        << mortise_last_error(one_of);
    EXPECT_EQ(C, entries(next_C));
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, SameValues, ::testing::Range<std::size_t>(0, cases().size()),
                         [](const auto& info) { return cases()[info.param].name; });

// The loop of updates is that of ContactSystem::augment().
TEST(PlainAugmentation, UpdatesUntilTheMultipliersAreExact) {
  TwoSurfaces surfaces = arch_on_ground();
  surfaces.options.formulation = {"augmented lagrange", std::make_shared<AugmentedLagrange>(), {}};
  const Fixture fixture(surfaces, Tpetra::getDefaultComm());
  const ContactSystem& contact = *fixture.contact;
  PlainHost host(PlainArrays(surfaces, fixture));
  host.set_up("formulation/type = augmented lagrange");
  const auto at = Fixture::vector(fixture.dofs, [](GlobalOrdinal id) { return 0.01 * wiggle(id); });
  const std::vector<double> d = entries(*at);
  Vector z(contact.multiplier_map());
  std::optional<ContactHistory> history = contact.start_step(contact.initial_history(*at), *at, z);
  std::vector<double> plain_z(static_cast<std::size_t>(host.multipliers), 0.0);
  ASSERT_EQ(mortise_start_step(host.contact, host.rows, host.multipliers, d.data(), nullptr, plain_z.data()), MORTISE_OK);
  for (int round = 1; round <= 3; ++round) {
    const ContactLaws laws = contact.evaluate(*at, *history).laws(z);
    const Augmentation update = contact.augment(laws, round);
    ASSERT_EQ(mortise_evaluate(host.contact, host.rows, host.multipliers, d.data(), nullptr, plain_z.data(), nullptr, nullptr, nullptr), MORTISE_OK);
    mortise_augmentation plain{};
    ASSERT_EQ(mortise_augment(host.contact, &plain), MORTISE_OK) << host.error();
    EXPECT_EQ(plain.more, update.more ? 1 : 0);
    EXPECT_EQ(plain.error, update.error);
    EXPECT_EQ(plain.exhausted, 0);
    ASSERT_TRUE(update.history);
    EXPECT_EQ(mortise_accept(host.contact), MORTISE_WRONG_ORDER) << "before a solve with the new start";
    history = update.history;
  }
}

}  // namespace
}  // namespace mortise
