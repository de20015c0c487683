// Errors of a host application, which are reported on every rank.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <utility>

#include "misuse_host.hpp"
#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "pairs/pair_history.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using test::Host;
using test::thrown;
using ::testing::HasSubstr;

TEST(Misuse, PairsThatAreNotComplete) {
  EXPECT_EQ(Host().refused<std::exception>(), "");
  Host soft;
  soft.pair.youngs_modulus = 0.0;
  EXPECT_THAT(soft.refused<InputError>(), HasSubstr("contact/joint: Young's modulus is 0"));
  soft.pair.youngs_modulus = std::nan("");
  EXPECT_THAT(soft.refused<InputError>(), HasSubstr("Young's modulus is nan"));
  Host lawless;
  lawless.pair.options.friction.options = nullptr;
  EXPECT_THAT(lawless.refused<InputError>(), HasSubstr("contact/joint: the law of friction is null"));
  Host formless;
  formless.pair.options.formulation.options = nullptr;
  EXPECT_THAT(formless.refused<InputError>(), HasSubstr("contact/joint: the formulation is null"));
}

// The facet is 1 long and Young's modulus 1.
TEST(Misuse, AComplementarityConstantThatLeavesTheChoiceToErrorsOfTheIteration) {
  for (const double constant : {1e-4, 1.1e-4, 1.0, 0.9e4, 1e4}) {
    Host sound;
    sound.pair.options.complementarity_constant = constant;
    EXPECT_EQ(sound.refused<InputError>(), "") << constant;
  }
  for (const double constant : {std::nan(""), -1.0, 0.0, 1e-300, 0.9e-4, 1.1e4, 1e300}) {
    Host unsound;
    unsound.pair.options.complementarity_constant = constant;
    EXPECT_THAT(unsound.refused<InputError>(), HasSubstr("contact/joint: \"complementarity constant\" is")) << constant;
  }
}

TEST(Misuse, MapsThatDoNotFit) {
  Host shifted;
  std::vector<GlobalOrdinal> ids;
  for (const GlobalOrdinal node : local_ids(*shifted.nodes))
    for (int i = 0; i < 2; ++i) ids.push_back(2 * node + i + 8);
  shifted.dofs = rcp(new Map(8, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, shifted.comm));
  EXPECT_THAT(shifted.refused<std::invalid_argument>(), HasSubstr("which is no owned row of the system"));
  // A component that the host has eliminated has to be prescribed.
  Host eliminated;
  const auto contact_of = [&] {
    std::vector<GlobalOrdinal> field;
    for (const GlobalOrdinal node : local_ids(*eliminated.nodes))
      for (int i = 0; i < 2; ++i) field.push_back(node == 1 && i == 0 ? NodalField::none : 2 * node + i);
    ContactSystem(NodalField("displacement", eliminated.nodes, 2, field), eliminated.dofs, eliminated.reference, eliminated.fixed, {},
                  {eliminated.pair}, Timers());
  };
  EXPECT_NE(thrown<std::invalid_argument>(contact_of), "");
  if (eliminated.nodes->isNodeGlobalElement(1)) {
    eliminated.fixed->replaceGlobalValue(1, 0, 1.0);
    eliminated.fixed->replaceGlobalValue(1, 1, 1.0);
  }
  EXPECT_EQ(thrown<std::exception>(contact_of), "");
  Host one_column;
  one_column.fixed = rcp(new MultiVector(one_column.nodes, 1));
  EXPECT_THAT(one_column.refused<std::invalid_argument>(), HasSubstr("prescribed components have 1 columns"));
  Host of_dofs;
  of_dofs.reference = rcp(new MultiVector(of_dofs.dofs, 2));
  EXPECT_THAT(of_dofs.refused<std::invalid_argument>(), HasSubstr("one row for each node"));
}

TEST(Misuse, FacetsOfUnknownNodes) {
  Host slave, master;
  if (!slave.pair.slave.empty()) slave.pair.slave = {{0, 99}};
  EXPECT_THAT(slave.refused<InputError>(), HasSubstr("contact/joint: the slave surface names node 99, which the model does not have"));
  if (!master.pair.master.empty()) master.pair.master = {{2, 99}};
  EXPECT_THAT(master.refused<InputError>(), HasSubstr("contact/joint: the master surface names node 99, which the model does not have"));
}

TEST(Misuse, FacetsOnTheWrongRanks) {
  Host twice;
  twice.pair.master = {{2, 3}, {3, 2}};
  EXPECT_THAT(twice.refused<InputError>(), HasSubstr("the master facet of nodes 2, 3 is given on rank 0 and again on rank 0"));
  if (twice.comm->getSize() == 1) return;
  twice.pair.master = {{2, 3}};
  EXPECT_THAT(twice.refused<InputError>(), HasSubstr("the master facet of nodes 2, 3 is given on rank 0 and again on rank 1"));
  for (const int rank : {0, 1}) {
    Host missing, turned;
    if (missing.comm->getRank() == rank) missing.pair.slave.clear();
    EXPECT_THAT(missing.refused<InputError>(), HasSubstr("the slave facet of nodes 0, 1, as rank " + std::to_string(1 - rank) +
                                                         " gives it, is not given on rank " + std::to_string(rank)));
    if (turned.comm->getRank() == rank) turned.pair.slave = {{1, 0}};
    EXPECT_THAT(turned.refused<InputError>(), HasSubstr("is not given on rank"));
  }
}

// Calls out of order do not compile.

template <class Evaluation, class = void>
struct CanLinearise : std::false_type {};
template <class Evaluation>
struct CanLinearise<Evaluation, std::void_t<decltype(std::declval<const Evaluation&>().linearise(std::declval<const ContactLaws&>()))>>
    : std::true_type {};

static_assert(CanLinearise<DifferentiatedContact>::value);
static_assert(!CanLinearise<ContactEvaluation>::value, "an evaluation without derivatives has no linearisation");
static_assert(!std::is_constructible_v<DifferentiatedContact, ContactEvaluation>, "derivatives come from differentiate() alone");
static_assert(!std::is_default_constructible_v<ContactHistory>, "there is no step without a history");
static_assert(!std::is_default_constructible_v<ContactEvaluation> && !std::is_default_constructible_v<DifferentiatedContact>);
static_assert(!std::is_default_constructible_v<ContactLaws>, "there are no conditions without an evaluation");
static_assert(!std::is_default_constructible_v<NodeElimination>, "nothing is recovered before condense()");

/// A model, and a step from where it starts.
struct Started {
  explicit Started(const std::shared_ptr<Formulation>& formulation = std::make_shared<DualMortar>()) : fixture(make_fixture(formulation)) {}

  static Fixture make_fixture(const std::shared_ptr<Formulation>& formulation) {
    test::TwoSurfaces surfaces = test::arch_on_ground();
    surfaces.options.formulation.options = formulation;
    const auto coulomb = std::make_shared<CoulombFriction>();
    coulomb->coefficient = ScalarFunction(0.3);
    surfaces.options.friction.options = coulomb;
    return {surfaces, Tpetra::getDefaultComm()};
  }
  DifferentiatedContact differentiate(double right = 0.0) const {
    const auto at = Fixture::vector(fixture.dofs, [&](GlobalOrdinal id) { return id < 12 && id % 2 == 0 ? right : 0.0; });
    return contact.differentiate(*at, history);
  }
  RCP<Matrix> matrix_for(const ContactEvaluation& at) const {
    return fixture.springs(contact.graph(at, [&] { return fixture.bulk; }));
  }
  std::string add_stiffness(const DifferentiatedContact& at, Matrix& matrix) const {
    const ContactLinearisation linearised = at.linearise(at.laws(z));
    return thrown<std::logic_error>([&] { linearised.add_stiffness(matrix); });
  }
  std::string condense(const DifferentiatedContact& at, Matrix& matrix) const {
    const ContactLinearisation linearised = at.linearise(at.laws(z));
    Vector rhs(fixture.dofs);
    return thrown<std::logic_error>([&] { linearised.condense(matrix, rhs); });
  }

  Fixture fixture;
  const ContactSystem& contact = *fixture.contact;
  Vector d{fixture.dofs}, z{contact.multiplier_map()};
  ContactHistory history = fixture.first_step(d, z);
};

TEST(Misuse, MatricesOnAnotherGraph) {
  const Started model;
  const DifferentiatedContact at = model.differentiate();
  Matrix of_bulk(model.fixture.bulk);
  EXPECT_THAT(model.add_stiffness(at, of_bulk), HasSubstr("not on the graph of this evaluation")) << "before any graph()";
  EXPECT_THAT(model.condense(at, of_bulk), HasSubstr("not on the graph of this evaluation")) << "before any graph()";
  const RCP<Matrix> matrix = model.matrix_for(at);
  EXPECT_EQ(model.add_stiffness(at, *matrix), "");
  EXPECT_EQ(model.condense(at, *matrix), "");
  EXPECT_THAT(model.condense(at, of_bulk), HasSubstr("not on the graph of this evaluation"));
}

TEST(Misuse, MatricesOfOtherCandidates) {
  const Started model;
  const RCP<Matrix> before = model.matrix_for(model.differentiate());
  const DifferentiatedContact away = model.differentiate(2.3);
  EXPECT_THAT(model.condense(away, *before), HasSubstr("not on the graph of this evaluation")) << "before its own graph()";
  const RCP<Matrix> matrix = model.matrix_for(away);
  EXPECT_NE(matrix->getCrsGraph().get(), before->getCrsGraph().get());
  EXPECT_THAT(model.condense(away, *before), HasSubstr("not on the graph of this evaluation"));
  EXPECT_EQ(model.condense(away, *matrix), "");
}

TEST(Misuse, MatricesThatAreComplete) {
  const Started model;
  const DifferentiatedContact at = model.differentiate();
  const RCP<Matrix> matrix = model.matrix_for(at);
  matrix->fillComplete(model.fixture.dofs, model.fixture.dofs);
  EXPECT_THAT(model.add_stiffness(at, *matrix), HasSubstr("resumeFill()"));
  EXPECT_THAT(model.condense(at, *matrix), HasSubstr("resumeFill()"));
  matrix->resumeFill();
  EXPECT_EQ(model.add_stiffness(at, *matrix), "");
}

TEST(Misuse, CondensationOfMultipliersThatAreKept) {
  const Started model(std::make_shared<StandardMortar>());
  const DifferentiatedContact at = model.differentiate();
  EXPECT_TRUE(model.contact.keeps_multipliers());
  EXPECT_THAT(model.condense(at, *model.matrix_for(at)), HasSubstr("saddle_point_blocks()"));
}

// Of another evaluation are those at the same displacement too, and those seen with another history.
TEST(Misuse, LawsOfAnotherEvaluation) {
  const Started model;
  const DifferentiatedContact at = model.differentiate(), again = model.differentiate(), other = at.with(model.history);
  const auto refusal = [&](const ContactLaws& laws) { return thrown<std::logic_error>([&] { at.linearise(laws); }); };
  EXPECT_EQ(refusal(at.laws(model.z)), "");
  EXPECT_THAT(refusal(again.laws(model.z)), HasSubstr("laws of another evaluation"));
  EXPECT_THAT(refusal(other.laws(model.z)), HasSubstr("laws of another evaluation"));
  EXPECT_THAT(refusal(model.contact.evaluate(model.d, model.history).laws(model.z)), HasSubstr("laws of another evaluation"));
}

TEST(Misuse, VectorsOnOtherMaps) {
  const Started model;
  const ContactSystem& contact = model.contact;
  const Vector& z = model.z;
  Vector on_dofs(model.fixture.dofs), on_multipliers(contact.multiplier_map());
  const auto refused = [](const auto& call) { return thrown<std::invalid_argument>(call); };
  EXPECT_THAT(refused([&] { contact.evaluate(z, model.history); }), HasSubstr("evaluate(): `d` has "));
  EXPECT_THAT(refused([&] { contact.differentiate(z, model.history); }), HasSubstr("differentiate(): `d` has "));
  EXPECT_THAT(refused([&] { contact.initial_history(z); }), HasSubstr("initial_history(): `d` has "));
  Vector guess(model.fixture.dofs);
  EXPECT_THAT(refused([&] { contact.start_step(model.history, model.d, guess); }), HasSubstr("start_step(): `z` has "));
  const MultiVector of_nodes(model.fixture.dofs, 2);
  EXPECT_THAT(refused([&] { contact.evaluate({model.d, of_nodes}, model.history); }), HasSubstr("`NodalDisplacement::nodes` has "));
  const DifferentiatedContact at = model.differentiate();
  EXPECT_THAT(refused([&] { at.laws(on_dofs); }), HasSubstr("laws(): `z` has "));
  EXPECT_THAT(refused([&] { at.add_force(on_dofs, on_dofs); }), HasSubstr("add_force(): `z` has "));
  EXPECT_THAT(refused([&] { at.add_force(z, on_multipliers); }), HasSubstr("add_force(): `r` has "));
  const ContactLaws laws = at.laws(z);
  EXPECT_THAT(refused([&] { laws.complementarity(on_dofs); }), HasSubstr("complementarity(): `C` has "));
  EXPECT_THAT(refused([&] { laws.add_force(on_multipliers); }), HasSubstr("add_force(): `r` has "));
  const RCP<Matrix> matrix = model.matrix_for(at);
  EXPECT_THAT(refused([&] { at.linearise(laws).condense(*matrix, on_multipliers); }), HasSubstr("condense(): `rhs` has "));
  const NodeElimination condensed = at.linearise(laws).condense(*matrix, on_dofs);
  EXPECT_THAT(refused([&] { condensed.recover(z, on_multipliers); }), HasSubstr("recover(): `dd` has "));
  EXPECT_THAT(refused([&] { condensed.recover(on_dofs, on_dofs); }), HasSubstr("recover(): `z` has "));
  EXPECT_THAT(refused([&] { condensed.apply(on_multipliers); }), HasSubstr("apply(): `rhs` has "));
}

TEST(Misuse, HistoriesAndValuesOfOtherSystems) {
  const Started model;
  test::TwoSurfaces surfaces = test::arch_on_ground();
  const Fixture frictionless(surfaces, Tpetra::getDefaultComm());
  surfaces.slave.pop_back();
  surfaces.fixed.assign(surfaces.size(), {});
  const Fixture smaller(surfaces, Tpetra::getDefaultComm());
  const auto refused = [&](const ContactHistory& history) {
    return thrown<std::invalid_argument>([&] { model.contact.evaluate(model.d, history); });
  };
  Vector d(smaller.dofs);
  EXPECT_THAT(refused(smaller.contact->initial_history(d)), HasSubstr("the history is that of another system"));
  Vector same(frictionless.dofs);
  EXPECT_THAT(refused(frictionless.contact->initial_history(same)), HasSubstr("is with friction, in the history without"));
  AcceptedContact two = *model.history;
  two.pairs.push_back(two.pairs.front());
  two.states.push_back(two.states.front());
  EXPECT_THAT(refused(ContactHistory(two)), HasSubstr("it has 2 pairs, this one 1"));
  AcceptedContact unplaced = *model.history;
  unplaced.positions = Teuchos::null;
  EXPECT_THAT(refused(ContactHistory(unplaced)), HasSubstr("it has no positions"));
  EXPECT_EQ(refused(model.history), "");

  const Started other;
  const ContactLaws foreign = other.differentiate().laws(other.z);
  EXPECT_THAT(thrown<std::logic_error>([&] { model.contact.commit(foreign); }), HasSubstr("commit() with a value of another system"));
  EXPECT_THAT(thrown<std::logic_error>([&] { model.contact.augment(foreign, 1); }), HasSubstr("augment() with a value of another system"));
  EXPECT_THAT(thrown<std::logic_error>([&] { model.matrix_for(other.differentiate()); }), HasSubstr("graph() with a value of another system"));
  const ContactStates states;
  EXPECT_THAT(thrown<std::invalid_argument>([&] { model.differentiate().laws(model.z).norms(states); }), HasSubstr("states are those of another"));
  EXPECT_THAT(thrown<std::invalid_argument>([&] { model.contact.differentiate(model.d, model.history, &states); }), HasSubstr("states are those"));
  EXPECT_THAT(thrown<std::out_of_range>([&] { model.contact.slave_ids(1); }), HasSubstr("there is no pair 1; the system has 1"));
  EXPECT_THAT(thrown<std::out_of_range>([&] { node_states(foreign, 1); }), HasSubstr("there is no pair 1"));
}

TEST(Misuse, NumbersThatAreNotFinite) {
  const Started model;
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto d = Fixture::vector(model.fixture.dofs, [&](GlobalOrdinal id) { return id == 5 ? value : 0.0; });
    EXPECT_THAT(thrown<StepFailure>([&] { model.contact.differentiate(*d, model.history); }), HasSubstr("node 2 is not finite"));
    const GlobalOrdinal first = model.contact.multiplier_map()->getMinAllGlobalIndex();
    const auto z = Fixture::vector(model.contact.multiplier_map(), [&](GlobalOrdinal id) { return id == first ? value : 0.0; });
    EXPECT_THAT(thrown<StepFailure>([&] { model.differentiate().laws(*z); }), HasSubstr("the multiplier of pair"));
  }
}

TEST(Misuse, MatricesThatWereChangedBefore) {
  Started model;
  model.z.putScalar(1.0);
  const auto down = Fixture::vector(model.fixture.dofs, [&](GlobalOrdinal id) { return id < 12 && id % 2 == 1 ? -0.5 : 0.0; });
  const DifferentiatedContact at = model.contact.differentiate(*down, model.history);
  const RCP<Matrix> matrix = model.matrix_for(at);
  ASSERT_GT(at.laws(model.z).norms(model.history->states).active, 0);
  EXPECT_EQ(model.condense(at, *matrix), "");
  EXPECT_THAT(model.condense(at, *matrix), HasSubstr("condensed already"));
  EXPECT_EQ(model.condense(at, *model.matrix_for(at)), "");
}

TEST(Misuse, FacetsInsideOut) {
  const auto orientation = [](bool slave, bool master) {
    test::TwoSurfaces surfaces = test::arch_on_ground();
    if (slave) std::reverse(surfaces.slave.begin(), surfaces.slave.end());
    if (master) std::reverse(surfaces.master.begin(), surfaces.master.end());
    const Fixture fixture(surfaces, Tpetra::getDefaultComm());
    Vector d(fixture.dofs);
    return facet_orientation(fixture.contact->evaluate(d, fixture.contact->initial_history(d)), 0);
  };
  EXPECT_FALSE(orientation(false, false).is_inside_out());
  EXPECT_GT(orientation(false, false).facing, 0);
  EXPECT_TRUE(orientation(true, false).is_inside_out());
  EXPECT_TRUE(orientation(false, true).is_inside_out());
  EXPECT_THAT(thrown<std::out_of_range>([] {
                const Started model;
                facet_orientation(model.differentiate(), 7);
              }),
              HasSubstr("there is no pair 7"));
}

}  // namespace
}  // namespace mortise
