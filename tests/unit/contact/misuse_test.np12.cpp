// Errors of a host application, which are reported on every rank.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <type_traits>
#include <utility>

#include "mortise/contact/formulation/standard_mortar.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "two_surfaces.hpp"

namespace mortise {
namespace {

using test::Fixture;
using ::testing::HasSubstr;

/// Message of the exception that is thrown, on every rank alike: "" if there is none.
template <class Error, class Call>
std::string thrown(const Call& call) {
  std::string text;
  try {
    call();
  } catch (const Error& error) {
    text = error.what();
  }
  int mine = text.empty() ? 0 : 1, all = 0;
  Teuchos::reduceAll(*Tpetra::getDefaultComm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  EXPECT_EQ(all, mine * Tpetra::getDefaultComm()->getSize()) << "not on every rank";
  return text;
}

/// Two facets that face each other, node n on rank n modulo the ranks, and how they are given.
struct Host {
  RCP<const Communicator> comm = Tpetra::getDefaultComm();
  RCP<const Map> nodes = owned(), dofs = make_dof_map(*nodes, 2);
  RCP<MultiVector> reference = rcp(new MultiVector(nodes, 2)), fixed = rcp(new MultiVector(nodes, 2));
  ContactPair pair;

  Host() {
    pair.name = "joint";
    pair.youngs_modulus = 1.0;
    const double x[4] = {0.0, 1.0, 1.0, 0.0};
    for (const GlobalOrdinal node : local_ids(*nodes)) reference->replaceGlobalValue(node, 0, x[node]);
    const auto mine = [&](GlobalOrdinal node) { return nodes->isNodeGlobalElement(node); };
    if (mine(0) || mine(1)) pair.slave = {{0, 1}};
    if (mine(2)) pair.master = {{2, 3}};
  }
  RCP<const Map> owned() const {
    std::vector<GlobalOrdinal> ids;
    for (GlobalOrdinal node = 0; node < 4; ++node)
      if (node % comm->getSize() == comm->getRank()) ids.push_back(node);
    return rcp(new Map(4, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, comm));
  }
  template <class Error>
  std::string refused() const {
    return thrown<Error>([&] { ContactSystem(nodes, dofs, reference, fixed, {}, {pair}, Timers()); });
  }
};

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

}  // namespace
}  // namespace mortise
