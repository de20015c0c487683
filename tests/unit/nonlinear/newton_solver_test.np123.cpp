// Newton's method on a nonlinear solid without contact.

#include "mortise/nonlinear/newton_solver.hpp"

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <limits>

#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Problem;

Problem::Choices loaded() {
  Problem::Choices choices;
  choices.force = {0.02, 0.05};
  return choices;
}

Problem::Choices moved() {
  Problem::Choices choices;
  choices.motion = {0.8, 0.5};
  return choices;
}

NewtonReport solve(Problem& problem, const NewtonOptions& options = {}) {
  NewtonReport report;
  Tpetra::deep_copy(*problem.x, solve_newton(*problem.system, problem.evaluate(1.0), options, report, {}).x());
  return report;
}

FailureKind failure_of(Problem& problem, const NewtonOptions& options, NewtonReport& report) {
  try {
    solve_newton(*problem.system, problem.evaluate(1.0), options, report, {});
  } catch (const StepFailure& failure) {
    EXPECT_NE(std::string(failure.what()), "");
    return failure.kind();
  }
  ADD_FAILURE() << "converged";
  return FailureKind::material;
}

// |r_{k+1}| <= C |r_k|^2: from one iterate to the next the number of right digits doubles, until round-off. Ratios of logarithms of
// successive reductions approach 2; the reductions that count are those below 1e-2, and above round-off.
TEST(Newton, ConvergesQuadratically) {
  for (const auto& choices : {loaded(), moved()}) {
    Problem problem(Tpetra::getDefaultComm(), choices);
    const NewtonReport report = solve(problem);
    std::vector<double> r;
    for (const auto& iteration : report.iterations) r.push_back(iteration.norms.momentum);
    EXPECT_LE(r.back(), 1e-9);
    int pairs = 0;
    for (std::size_t k = 1; k + 1 < r.size(); ++k) {
      if (r[k] > 1e-2 || r[k + 1] < 1e-13) continue;
      EXPECT_LE(r[k + 1], 100.0 * r[k] * r[k]) << "iteration " << k;
      ++pairs;
    }
    EXPECT_GE(pairs, 2);
    EXPECT_LE(report.newton_steps(), 8);
  }
}

TEST(Newton, ObserverSeesEachIterateOnce) {
  Problem problem(Tpetra::getDefaultComm(), loaded());
  std::vector<int> seen;
  NewtonReport report;
  solve_newton(*problem.system, problem.evaluate(1.0), {}, report, [&](const NewtonIteration& iteration) { seen.push_back(iteration.iteration); });
  ASSERT_EQ(seen.size(), report.iterations.size());
  for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_EQ(seen[k], static_cast<int>(k));
  EXPECT_EQ(report.iterations[0].increment, 0.0);
  EXPECT_GT(report.iterations[1].increment, 0.0);
}

// Sums of internal forces vanish, so the reactions of the fixed edge balance the load.
TEST(Newton, ReactionsBalanceTheLoad) {
  Problem problem(Tpetra::getDefaultComm(), loaded());
  solve(problem);
  const RCP<const Vector> r = problem.evaluate(1.0).forces();
  double mine[2] = {0.0, 0.0}, all[2];
  for (const int node : problem.grid->owned_nodes()) {
    if (node >= problem.grid->nx()) continue;
    for (int i = 0; i < 2; ++i) mine[i] += r->getData()[problem.grid->dofs->getLocalElement(problem.grid->dof(node, i))];
  }
  Teuchos::reduceAll(*problem.grid->dofs->getComm(), Teuchos::REDUCE_SUM, 2, mine, all);
  // The imbalance is at most |r| of the free dofs: 60 of them, 1e-9 of a load of 0.13.
  EXPECT_NEAR(all[0], -6 * 0.02, 1e-8);
  EXPECT_NEAR(all[1], -6 * 0.05, 1e-8);
}

TEST(Newton, AgreesWithOneRank) {
  for (const auto& choices : {loaded(), moved()}) {
    Problem problem(Tpetra::getDefaultComm(), choices), alone(test::this_rank_only(), choices);
    const NewtonReport report = solve(problem), alone_report = solve(alone);
    EXPECT_EQ(report.newton_steps(), alone_report.newton_steps());
    const double size = alone.x->normInf();
    EXPECT_GT(size, 0.1);
    const auto mine = problem.x->getData(), whole = alone.x->getData();
    for (std::size_t i = 0; i < problem.x->getLocalLength(); ++i) {
      const GlobalOrdinal id = problem.grid->dofs->getGlobalElement(static_cast<LocalOrdinal>(i));
      EXPECT_NEAR(mine[i], whole[alone.grid->dofs->getLocalElement(id)], 1e-10 * size);
    }
  }
}

TEST(Newton, IterativeAndDirectSolversAgree) {
  Problem::Choices choices = loaded();
  choices.nx = 14;
  choices.ny = 12;
  choices.numbering = test::Numbering::blocks;
  choices.force = {0.002, 0.01};
  Problem direct(Tpetra::getDefaultComm(), choices);
  choices.linear_solver.kind.value = LinearSolverOptions::Kind::iterative;
  Problem iterative(Tpetra::getDefaultComm(), choices);
  const NewtonReport direct_report = solve(direct), iterative_report = solve(iterative);
  EXPECT_EQ(direct_report.newton_steps(), iterative_report.newton_steps());
  EXPECT_GT(iterative_report.iterations[1].linear_iterations, 0);
  iterative.x->update(-1.0, *direct.x, 1.0);
  EXPECT_LE(iterative.x->normInf(), 1e-8 * direct.x->normInf());
}

// Another unit of force: stiffness and forces change by one factor, the path of the iteration does not.
TEST(Newton, UnitsDoNotMatter) {
  std::vector<std::vector<double>> paths;
  for (const double stiffness : {1.0, 1e-3, 1e9}) {
    Problem::Choices choices = loaded();
    choices.motion.reset();
    choices.stiffness = stiffness;
    choices.force = {0.02 * stiffness, 0.05 * stiffness};
    Problem problem(Tpetra::getDefaultComm(), choices);
    paths.emplace_back();
    for (const auto& iteration : solve(problem).iterations) paths.back().push_back(iteration.norms.momentum);
  }
  for (const auto& path : paths) {
    ASSERT_EQ(path.size(), paths[0].size());
    for (std::size_t k = 0; k < path.size(); ++k) EXPECT_NEAR(path[k], paths[0][k], 1e-12);
  }
}

TEST(Newton, NothingToDoTakesNoStep) {
  Problem problem(Tpetra::getDefaultComm(), {});
  EXPECT_EQ(solve(problem).newton_steps(), 0);
  // A solution is left as it is.
  Problem again(Tpetra::getDefaultComm(), loaded());
  NewtonOptions strict;
  strict.momentum_tolerance = 1e-12;
  solve(again, strict);
  EXPECT_EQ(solve(again).newton_steps(), 0);
}

TEST(Newton, GivesUpAfterTheAllowedIterationsAndSaysWhatIsMissing) {
  Problem problem(Tpetra::getDefaultComm(), loaded());
  NewtonOptions options;
  options.maximum_iterations = 2;
  NewtonReport report;
  try {
    solve_newton(*problem.system, problem.evaluate(1.0), options, report, {});
    FAIL() << "converged";
  } catch (const StepFailure& failure) {
    EXPECT_EQ(failure.kind(), FailureKind::too_many_iterations);
    EXPECT_NE(std::string(failure.what()).find("momentum (tolerance 1.0e-09): "), std::string::npos) << failure.what();
  }
  EXPECT_EQ(report.newton_steps(), 2);
}

TEST(Newton, FailuresInTheResidualPassThroughNox) {
  Problem::Choices choices = moved();
  choices.motion = {0.0, -4.2};  // the upper edge goes below the lower one
  Problem problem(Tpetra::getDefaultComm(), choices);
  NewtonReport report;
  EXPECT_EQ(failure_of(problem, {}, report), FailureKind::inverted_element);
  EXPECT_GE(report.iterations.size(), 1u);  // what was done before stands
}

TEST(Newton, FailuresOfTheLinearSolverPassThroughNox) {
  Problem::Choices choices = loaded();
  choices.linear_solver.residual_bound = 1e-300;
  Problem problem(Tpetra::getDefaultComm(), choices);
  NewtonReport report;
  EXPECT_EQ(failure_of(problem, {}, report), FailureKind::linear_solver);
}

// Under a large load at once full steps turn springs inside out; shorter ones go around.
TEST(Newton, BacktrackingArrivesWhereFullStepsDoNot) {
  Problem::Choices choices = loaded();
  choices.force = {1.0, 0.2};
  Problem full(Tpetra::getDefaultComm(), choices), searched(Tpetra::getDefaultComm(), choices);
  NewtonOptions options;
  options.maximum_iterations = 60;
  options.line_search = LineSearch::none;
  NewtonReport report;
  EXPECT_EQ(failure_of(full, options, report), FailureKind::inverted_element);
  options.line_search = LineSearch::backtrack;
  const NewtonReport found = solve(searched, options);
  double shortest = 1.0;
  for (std::size_t k = 1; k < found.iterations.size(); ++k) {
    EXPECT_LT(found.iterations[k].norms.merit, found.iterations[k - 1].norms.merit);
    shortest = std::min(shortest, found.iterations[k].step_length);
  }
  EXPECT_LT(shortest, 1.0);
  EXPECT_EQ(found.iterations.back().step_length, 1.0);  // quadratic in the end
  EXPECT_LE(found.iterations.back().norms.momentum, options.momentum_tolerance);
}

TEST(Newton, BacktrackingChangesNothingWhereFullStepsFall) {
  Problem full(Tpetra::getDefaultComm(), moved()), searched(Tpetra::getDefaultComm(), moved());
  NewtonOptions full_steps;
  full_steps.line_search = LineSearch::none;
  EXPECT_EQ(solve(full, full_steps).newton_steps(), solve(searched).newton_steps());
  full.x->update(-1.0, *searched.x, 1.0);
  EXPECT_LE(full.x->normInf(), 1e-14);
}

TEST(Newton, WhatCannotBeEvaluatedHoweverShortTheStepIsSaysWhy) {
  Problem::Choices choices = moved();
  choices.reach = 1e-5;  // less than a thousandth of the motion
  Problem problem(Tpetra::getDefaultComm(), choices);
  NewtonReport report;
  EXPECT_EQ(failure_of(problem, {}, report), FailureKind::material);
  EXPECT_EQ(report.newton_steps(), 0);
}

// Pressed so hard that springs would have to turn over: |r| has a least value that is not 0, and no direction leads on from there.
TEST(Newton, ALineSearchThatFindsNothingIsAFailureOfItsOwn) {
  Problem::Choices choices = loaded();
  choices.force = {0.0, -1.0};
  Problem problem(Tpetra::getDefaultComm(), choices);
  NewtonReport report;
  EXPECT_EQ(failure_of(problem, {}, report), FailureKind::line_search);
}

TEST(Newton, CorrectionsAreShortenedToTheLargestIncrement) {
  Problem free(Tpetra::getDefaultComm(), moved()), limited(Tpetra::getDefaultComm(), moved());
  solve(free);
  NewtonOptions options;
  options.largest_increment = 0.2;
  options.maximum_iterations = 40;
  const NewtonReport report = solve(limited, options);
  EXPECT_LT(report.iterations[1].step_length, 1.0);
  for (const auto& iteration : report.iterations) EXPECT_LE(iteration.increment, 0.2 * (1.0 + 1e-14));
  EXPECT_EQ(report.iterations.back().step_length, 1.0);
  free.x->update(-1.0, *limited.x, 1.0);
  EXPECT_LE(free.x->normInf(), 1e-7);  // increments are converged to 1e-8 of the model's size of 5
}

TEST(Newton, NotFiniteIsAFailure) {
  Problem::Choices choices = loaded();
  choices.force = {std::numeric_limits<double>::quiet_NaN(), 0.0};
  Problem problem(Tpetra::getDefaultComm(), choices);
  NewtonReport report;
  EXPECT_EQ(failure_of(problem, {}, report), FailureKind::not_finite);
}

}  // namespace
}  // namespace mortise
