// The semi-smooth system and its Newton iteration with contact: a narrower body of springs pressed on another one.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "../contact/formulations.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/load_stepper.hpp"
#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Problem;

Problem::Choices pressed(double down, double sideways = 0.0, double stiffness = 1.0) {
  Problem::Choices choices;
  choices.nx = 8;
  choices.ny = 8;
  choices.cut = 4;
  choices.motion = {sideways, -down};
  choices.stiffness = stiffness;
  return choices;
}

// An iterate with closed and open nodes: the upper body is pushed in unevenly, multipliers are of either sign.
void mix_states(Problem& problem) {
  const auto d = problem.system->unknowns(*problem.x), z = problem.system->multipliers(*problem.x);
  for (const GlobalOrdinal id : local_ids(*d->getMap())) {
    const bool upper = id / 2 >= problem.grid->cut() * problem.grid->nx();
    d->replaceGlobalValue(id, 0.02 * std::sin(0.7 * id) - (upper && id % 2 == 1 ? 0.05 : 0.0));
  }
  for (const GlobalOrdinal id : local_ids(*z->getMap())) z->replaceGlobalValue(id, 0.05 * std::cos(1.1 * (id / 2)) - 0.01 * (id % 2));
}

// F and J at such an iterate.
SystemLinearisation with_mixed_states(Problem& problem) {
  mix_states(problem);
  return problem.system->linearise(problem.evaluate(1.0));
}

std::vector<test::NamedFormulation> formulations() {
  std::vector<test::NamedFormulation> all = test::other_formulations();
  all.insert(all.begin(), {"dual mortar", nullptr});
  return all;
}

/// With each formulation.
class ContactFormulation : public ::testing::TestWithParam<int> {
 protected:
  Problem::Choices choose(Problem::Choices choices) const {
    choices.formulation = formulations()[GetParam()].options;
    return choices;
  }
};
INSTANTIATE_TEST_SUITE_P(All, ContactFormulation, ::testing::Range(0, static_cast<int>(formulations().size())), [](const auto& info) {
  std::string name = formulations()[info.param].name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
});

TEST_P(ContactFormulation, JacobianAgreesWithCentralDifferences) {
  Problem problem(Tpetra::getDefaultComm(), choose(pressed(0.2)));
  SemiSmoothSystem& system = *problem.system;
  StepContext context = problem.context(1.0);
  mix_states(problem);
  Vector v(system.map()), J_v(system.map()), difference(system.map());
  for (const GlobalOrdinal id : local_ids(*system.map())) v.replaceGlobalValue(id, std::sin(0.91 * id));
  const SystemEvaluation at = system.evaluate(*problem.x, context);
  EXPECT_GT(at.norms().active, 0);
  EXPECT_LT(at.norms().active, 8);
  const double h = 1e-6;
  for (const double sign : {1.0, -1.0}) {
    Vector x(*problem.x, Teuchos::Copy);
    x.update(sign * h, v, 1.0);
    difference.update(sign / (2.0 * h), system.evaluate(x, context).residual(), 1.0);
  }
  context.states = at.contact_laws().states();
  EXPECT_GT(at.norms().changed, 0);
  EXPECT_EQ(system.evaluate(*problem.x, context).norms().changed, 0);
  system.linearise(at).apply(v, J_v);
  const double size = system.unknowns(J_v)->norm2(), law_size = system.multipliers(J_v)->norm2();
  difference.update(-1.0, J_v, 1.0);
  EXPECT_LE(system.unknowns(difference)->norm2(), 1e-6 * size);
  EXPECT_LE(system.multipliers(difference)->norm2(), 1e-6 * law_size);
}

// The step solves the whole system, prescribed rows and rows of C included, condensed or not.
TEST_P(ContactFormulation, DirectionSolvesTheSaddlePointSystem) {
  Problem problem(Tpetra::getDefaultComm(), choose(pressed(0.2, 0.1)));
  SemiSmoothSystem& system = *problem.system;
  Vector direction(system.map()), J_dx(system.map());
  const SystemLinearisation linearisation = with_mixed_states(problem);
  const Vector& F = linearisation.evaluation().residual();
  for (int repetition = 0; repetition < 2; ++repetition) {
    linearisation.newton_direction(F, direction);
    linearisation.apply(direction, J_dx);
    const double size = F.norm2();
    J_dx.update(1.0, F, 1.0);
    EXPECT_LE(J_dx.norm2(), 1e-11 * size);
  }
}

// J without C~ solves its system: what it leaves of the whole one is C~ dd = d(f_c)/dd dd at fixed multipliers, as differences find it.
TEST_P(ContactFormulation, DirectionWithoutGeometricStiffnessLeavesThatAlone) {
  Problem problem(Tpetra::getDefaultComm(), choose(pressed(0.2, 0.1)));
  SemiSmoothSystem& system = *problem.system;
  Vector direction(system.map()), J_dx(system.map());
  const SystemLinearisation linearisation = with_mixed_states(problem);
  const Vector& F = linearisation.evaluation().residual();
  linearisation.newton_direction(F, direction, 0.0, GeometricContactStiffness::left_out);
  linearisation.apply(direction, J_dx);
  J_dx.update(1.0, F, 1.0);

  const ContactSystem& contact = *system.parts().contact;
  const RCP<const Vector> d = system.unknowns(std::as_const(*problem.x)), z = system.multipliers(std::as_const(*problem.x)),
                          dd = system.unknowns(std::as_const(direction));
  Vector change(d->getMap());
  const double h = 1e-6 / dd->normInf();
  for (const double sign : {1.0, -1.0}) {
    Vector moved(*d, Teuchos::Copy), force(d->getMap());
    moved.update(sign * h, *dd, 1.0);
    contact.evaluate(moved, *linearisation.evaluation().context().contact).add_force(*z, force);
    change.update(sign / (2.0 * h), force, 1.0);
  }
  const double size = change.norm2();
  EXPECT_GT(size, 1e-3 * F.norm2());
  Vector left(*system.unknowns(std::as_const(J_dx)), Teuchos::Copy);
  EXPECT_LE(system.multipliers(std::as_const(J_dx))->norm2(), 1e-11 * F.norm2());
  for (const LocalOrdinal dof : system.parts().constraints->prescribed()) change.replaceLocalValue(dof, 0.0);  // their rows are not momentum
  left.update(-1.0, change, 1.0);
  EXPECT_LE(left.norm2(), 1e-6 * size);
}

struct Solved {
  SystemEvaluation at;
  NewtonReport report;
  double reaction[2][2] = {};  // of the lower and the upper edge
};

Solved solve(Problem& problem, SystemEvaluation start) {
  NewtonReport report;
  Solved solved{solve_newton(*problem.system, std::move(start), {}, report, {}), {}};
  solved.report = report;
  Tpetra::deep_copy(*problem.x, solved.at.x());
  const RCP<const Vector> r = solved.at.forces();
  double mine[4] = {};
  for (const int node : problem.grid->owned_nodes())
    for (int i = 0; i < 2; ++i) {
      const double value = r->getData()[problem.grid->dofs->getLocalElement(problem.grid->dof(node, i))];
      if (node < problem.grid->nx()) mine[i] += value;
      if (node / problem.grid->nx() == problem.grid->ny() - 1) mine[2 + i] += value;
    }
  Teuchos::reduceAll(*problem.grid->dofs->getComm(), Teuchos::REDUCE_SUM, 4, mine, &solved.reaction[0][0]);
  return solved;
}
Solved solve(Problem& problem) { return solve(problem, problem.evaluate(1.0)); }

TEST_P(ContactFormulation, ConvergesQuadraticallyOnceTheSetHasSettled) {
  Problem problem(Tpetra::getDefaultComm(), choose(pressed(0.25)));
  const Solved solved = solve(problem);
  const auto& iterations = solved.report.iterations;
  EXPECT_GT(iterations.back().norms.active, 0);
  EXPECT_EQ(iterations.back().norms.changed, 0);
  EXPECT_LE(iterations.back().norms.gap, 1e-9);
  EXPECT_LE(iterations.back().norms.complementarity, 1e-9);
  int pairs = 0;
  for (std::size_t k = 1; k + 1 < iterations.size(); ++k) {
    const double before = iterations[k].norms.momentum, after = iterations[k + 1].norms.momentum;
    if (iterations[k].norms.changed > 0 || iterations[k + 1].norms.changed > 0 || before > 1e-2 || after < 1e-13) continue;
    EXPECT_LE(after, 100.0 * before * before) << "iteration " << k;
    ++pairs;
  }
  EXPECT_GE(pairs, 1);
}

// Newton's method then knows less and finds the same: more iterations, no other state.
TEST(ContactNewton, FrozenNormalsChangeTheWayAndNotTheSolution) {
  Problem::Choices choices = pressed(0.25);
  Problem exact(Tpetra::getDefaultComm(), choices);
  choices.linearisation = Linearisation::frozen_normals;
  Problem frozen(Tpetra::getDefaultComm(), choices);
  const Solved one = solve(exact), other = solve(frozen);
  EXPECT_GT(other.report.newton_steps(), one.report.newton_steps());
  Vector difference(*exact.x, Teuchos::Copy);
  difference.update(-1.0, *frozen.x, 1.0);
  EXPECT_LE(difference.normInf(), 1e-8 * exact.x->normInf());
}

// The force on the upper body arrives below; without friction on a level interface nothing goes sideways.
TEST_P(ContactFormulation, ForcesPassThroughTheInterface) {
  Problem problem(Tpetra::getDefaultComm(), choose(pressed(0.25)));
  const Solved solved = solve(problem);
  const double force = -solved.reaction[1][1];
  EXPECT_GT(force, 0.0);
  EXPECT_NEAR(solved.reaction[0][1], force, 1e-8 * force);
  EXPECT_NEAR(solved.reaction[0][0], -solved.reaction[1][0], 1e-8 * force);
}

TEST(ContactNewton, ABodyThatDoesNotReachFeelsNothing) {
  Problem problem(Tpetra::getDefaultComm(), pressed(0.04));  // the distance is 0.05
  const Solved solved = solve(problem);
  EXPECT_EQ(solved.report.iterations.back().norms.active, 0);
  EXPECT_NEAR(solved.reaction[1][1], 0.0, 1e-12);
}

TEST(ContactNewton, AgreesWithOneRankAndInOtherUnits) {
  Problem alone(test::this_rank_only(), pressed(0.25, 0.3));
  const Solved whole = solve(alone);
  for (const double stiffness : {1.0, 2e11, 3e-4}) {
    Problem problem(Tpetra::getDefaultComm(), pressed(0.25, 0.3, stiffness));
    const Solved solved = solve(problem);
    EXPECT_EQ(solved.report.newton_steps(), whole.report.newton_steps());
    for (int edge = 0; edge < 2; ++edge)
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(solved.reaction[edge][i] / stiffness, whole.reaction[edge][i], 1e-10 * std::abs(whole.reaction[1][1]));
    for (std::size_t k = 0; k < std::min(solved.report.iterations.size(), whole.report.iterations.size()); ++k) {
      EXPECT_EQ(solved.report.iterations[k].norms.active, whole.report.iterations[k].norms.active);
      EXPECT_EQ(solved.report.iterations[k].norms.active_set, whole.report.iterations[k].norms.active_set);
    }
  }
}

// The upper body slides over two nodes of the lower one: candidates, and with them the graph, change on the way, but not in each iteration.
TEST(ContactNewton, SlidesOverManyFacets) {
  Problem::Choices choices = pressed(0.15, 2.2);
  Problem problem(Tpetra::getDefaultComm(), choices);
  SteppingOptions stepping;
  stepping.step = 0.125;
  std::optional<StepFailure> failure;
  int iterations = 0, cutbacks = 0;
  StepperObserver observer;
  observer.iteration = [&](const NewtonIteration& iteration) { iterations += iteration.iteration > 0; };
  observer.accepted = [&](const StepReport& report, const SystemEvaluation&) { cutbacks += report.cutbacks; };
  const auto start = [&](const AcceptedState& from, double time, const Vector& d, Vector& z) { return problem.system->start_step(from, time, d, z); };
  SteppingState state(problem.system->initial_state(*problem.x));
  EXPECT_TRUE(run_steps(*problem.system, stepping, {}, state, start, observer, failure));
  EXPECT_EQ(cutbacks, 0);
  EXPECT_LT(problem.system->parts().linear_solver->symbolic_setups(), iterations);
  RecordProperty("iterations", iterations);
  RecordProperty("symbolic_setups", problem.system->parts().linear_solver->symbolic_setups());
}

TEST(ContactNewton, IterativeAndDirectSolversAgree) {
  Problem::Choices choices = pressed(0.25);
  choices.nx = 16;
  choices.ny = 16;
  choices.cut = 8;
  choices.numbering = test::Numbering::blocks;
  Problem direct(Tpetra::getDefaultComm(), choices);
  const Solved with_direct = solve(direct);
  choices.linear_solver.kind.value = LinearSolverOptions::Kind::iterative;
  choices.linear_solver.muelu.value.set("coarse: max size", 100);
  Problem iterative(Tpetra::getDefaultComm(), choices);
  const Solved with_iterative = solve(iterative);
  EXPECT_EQ(with_iterative.report.newton_steps(), with_direct.report.newton_steps());
  EXPECT_GT(with_iterative.report.iterations.back().linear_iterations, 0);
  RecordProperty("linear_iterations", with_iterative.report.iterations.back().linear_iterations);
  EXPECT_NEAR(with_iterative.reaction[1][1], with_direct.reaction[1][1], 1e-8 * std::abs(with_direct.reaction[1][1]));
}

// Each update divides the error of the multipliers by some factor: to 1e-14 of the largest takes more than two.
TEST(ContactNewton, AStepEndsWhenUpdatesOfTheMultipliersAreExhausted) {
  const auto formulation = std::make_shared<AugmentedLagrange>();
  formulation->tolerance = 1e-14;
  formulation->augmentations = 2;
  Problem::Choices choices = pressed(0.25);
  choices.formulation = formulation;
  Problem problem(Tpetra::getDefaultComm(), choices);
  SystemEvaluation start = problem.evaluate(1.0);
  for (int round = 1; round <= 2; ++round) {
    const auto updated = problem.system->augment(solve(problem, start).at, round);
    ASSERT_TRUE(updated) << round;
    start = *updated;
  }
  const Solved last = solve(problem, start);
  const auto expect_exhausted = [](const StepFailure& failure) {
    EXPECT_EQ(failure.kind(), FailureKind::augmentation);
    EXPECT_EQ(to_string(failure.kind()), "augmentation");
    EXPECT_THAT(failure.what(), ::testing::StartsWith("contact \"pair\": after 2 updates of the multipliers, one more would change them by "));
  };
  try {
    problem.system->augment(last.at, 3);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const StepFailure& failure) {
    expect_exhausted(failure);
  }

  Problem stepped(Tpetra::getDefaultComm(), choices);
  SteppingOptions stepping;
  stepping.minimum_step = stepping.step;
  std::optional<StepFailure> failure;
  SteppingState state(stepped.system->initial_state(*stepped.x));
  EXPECT_FALSE(run_steps(*stepped.system, stepping, {}, state, {}, {}, failure));
  ASSERT_TRUE(failure);
  expect_exhausted(*failure);
}

TEST(ContactSystem, AContextWithoutAHistoryIsRefused) {
  Problem problem(Tpetra::getDefaultComm(), pressed(0.2));
  EXPECT_THROW(problem.system->evaluate(*problem.x, StepContext{}), std::invalid_argument);
}

// A node that was closed in the accepted state may not go through the other body. The upper body is put three rows deep into the lower one, beyond
// the reach of one facet.
TEST(ContactSystem, ContactLostSinceTheAcceptedStateIsAFailureOnAllRanks) {
  Problem problem(Tpetra::getDefaultComm(), pressed(0.2));
  SemiSmoothSystem& system = *problem.system;
  const auto place = [&](double depth) {
    const auto d = system.unknowns(*problem.x);
    for (const GlobalOrdinal id : local_ids(*d->getMap()))
      d->replaceGlobalValue(id, id / 2 >= problem.grid->cut() * problem.grid->nx() && id % 2 == 1 ? -depth : 0.0);
  };
  place(3.0);
  AcceptedState state = system.initial_state(*problem.x);
  const auto sink = [&](double depth) {
    place(depth);
    return system.evaluate(*problem.x, system.step_from(state, 0.0));
  };
  EXPECT_EQ(sink(3.0).norms().active, 0);        // nothing was closed so far
  const SystemEvaluation touching = sink(0.06);  // a hundredth beyond the first gap
  EXPECT_GT(touching.norms().active, 0);
  state = system.commit(touching);
  sink(0.0);
  try {
    sink(3.0);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const StepFailure& failure) {
    EXPECT_EQ(failure.kind(), FailureKind::lost_contact);
  }
}

}  // namespace
}  // namespace mortise
