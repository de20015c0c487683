// Linear solvers: the true residual on any number of ranks, what is reused, what is refused.

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>

#include "linear_systems.hpp"

namespace mortise {
namespace {

using namespace test;

TEST(Automatic, IsIterativeForLargeSystemsOfSpaceThatItCanSolve) {
  const auto chosen = [](LinearSystemTraits traits) {
    LinearSolverOptions options;
    options.kind.value = Kind::automatic;
    return make_linear_solver(options, Tpetra::getDefaultComm(), Timers(), traits)->name();
  };
  constexpr GlobalOrdinal few = LinearSolverOptions::fewest_for_multigrid - 1, many = few + 1;
  EXPECT_EQ(chosen({many, 3, ""}), "automatic: GMRES + MueLu smoothed aggregation");
  EXPECT_EQ(chosen({few, 3, ""}), "automatic: MUMPS");
  EXPECT_EQ(chosen({many, 2, ""}), "automatic: MUMPS");
  EXPECT_EQ(chosen({many, 3, "it has multipliers"}), "automatic: MUMPS");
  LinearSolverOptions iterative;
  iterative.kind.value = Kind::iterative;
  EXPECT_THROW(make_linear_solver(iterative, Tpetra::getDefaultComm(), Timers(), {many, 3, "it has multipliers"}), InputError);
}

class Mumps : public ::testing::TestWithParam<Numbering> {};

// A backward stable solver leaves a residual of round-off times the condition number, here about 1e3.
TEST_P(Mumps, SolvesToRoundOff) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 17, 13, GetParam());
  const auto matrix = stiffness(grid, true);
  const auto b = loads(*grid);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::automatic);
  EXPECT_EQ(solver->name(), "automatic: MUMPS");
  solver->set_matrix(matrix, true, {});
  const LinearSolveReport report = solver->solve(*b, x);
  EXPECT_LE(true_residual(*matrix, *b, x), 1e-12);
  EXPECT_LE(report.relative_residual, 1e-12);
  EXPECT_EQ(report.iterations, 0);
}

// The determinant of a stable body is positive; a negative number in the place of a fixed dof turns its sign.
TEST_P(Mumps, TellsTheSignOfTheDeterminant) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 7, 5, GetParam());
  const auto b = loads(*grid);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::mumps);
  EXPECT_EQ(solver->determinant_sign(), 0);
  for (const double sign : {1.0, -1.0, 1.0}) {
    const auto matrix = stiffness(grid, true);
    matrix->resumeFill();
    const GlobalOrdinal fixed = grid->dof(0, 1);
    if (grid->dofs->isNodeGlobalElement(fixed)) matrix->replaceGlobalValues(fixed, 1, &sign, &fixed);
    matrix->fillComplete(grid->dofs, grid->dofs);
    solver->set_matrix(matrix, x.norm2() == 0.0, {});
    solver->solve(*b, x);
    EXPECT_EQ(solver->determinant_sign(), sign);
  }
}

INSTANTIATE_TEST_SUITE_P(Numberings, Mumps, ::testing::Values(Numbering::blocks, Numbering::scattered, Numbering::with_gaps));

TEST(MumpsReuse, AnalysisStandsWhileTheGraphDoes) {
  const auto comm = Tpetra::getDefaultComm();
  const auto grid = std::make_shared<SpringGrid>(comm, 9, 9);
  const auto b = loads(*grid);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::mumps);
  EXPECT_EQ(solver->symbolic_setups(), 0);
  for (const double scale : {1.0, 7.0, 0.01}) {
    const auto matrix = stiffness(grid, true, scale);
    solver->set_matrix(matrix, scale == 1.0, {});
    for (int repetition = 0; repetition < 2; ++repetition) {
      x.putScalar(0.0);
      solver->solve(*b, x);
      EXPECT_LE(true_residual(*matrix, *b, x), 1e-12);
    }
    EXPECT_EQ(solver->symbolic_setups(), 1);
  }
  // A matrix that is set and never solved with leaves no trace.
  solver->set_matrix(stiffness(grid, true, 3.0), false, {});
  const auto last = stiffness(grid, true, 5.0);
  solver->set_matrix(last, false, {});
  solver->solve(*b, x);
  EXPECT_LE(true_residual(*last, *b, x), 1e-12);

  const auto wider = std::make_shared<SpringGrid>(comm, 11, 8);
  const auto matrix = stiffness(wider, true);
  const auto other_b = loads(*wider);
  Vector other_x(wider->dofs);
  solver->set_matrix(matrix, true, {});
  solver->solve(*other_b, other_x);
  EXPECT_LE(true_residual(*matrix, *other_b, other_x), 1e-12);
  EXPECT_EQ(solver->symbolic_setups(), 2);
}

TEST(Singular, IsAStepFailureAndTheSolverGoesOn) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 8, 7);
  const auto b = loads(*grid);
  Vector x(grid->dofs);
  const auto zero = rcp(new Matrix(grid->graph));
  zero->fillComplete(grid->dofs, grid->dofs);
  // Springs alone, held nowhere: rigid motions, and loads that are not in equilibrium.
  const auto floating = rcp(new Matrix(grid->graph));
  std::optional<StepFailure> failure;
  Vector local_zero(grid->local_dofs);
  test::Springs(grid, 1.0).add_jacobian({0.0, x, local_zero}, {}, *floating, failure);
  floating->fillComplete(grid->dofs, grid->dofs);

  const auto solver = solver_of(Kind::mumps);
  for (const auto& matrix : {zero, floating}) {
    solver->set_matrix(matrix, true, {});
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const std::string message = failure_of(*solver, *b, x);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_NE(message.find("singular"), std::string::npos) << message;
  }
  const auto matrix = stiffness(grid, true);
  solver->set_matrix(matrix, false, {});
  solver->solve(*b, x);
  EXPECT_LE(true_residual(*matrix, *b, x), 1e-12);
}

// Springs that only the lower edge holds, by `foot` in each direction.
RCP<Matrix> weakly_held(const std::shared_ptr<SpringGrid>& grid, double foot) {
  const auto matrix = rcp(new Matrix(grid->graph));
  Vector zero(grid->dofs), local_zero(grid->local_dofs);
  std::optional<StepFailure> failure;
  test::Springs(grid, 1.0).add_jacobian({0.0, zero, local_zero}, {}, *matrix, failure);
  for (const int node : grid->owned_nodes())
    for (int i = 0; node < grid->nx() && i < 2; ++i) {
      const GlobalOrdinal id = grid->dof(node, i);
      matrix->sumIntoGlobalValues(id, 1, &foot, &id);
    }
  matrix->fillComplete(grid->dofs, grid->dofs);
  return matrix;
}

// The condition is some 1e12, so that |b - A x| / |b| stays far above 1e-8 however well the system is solved. The feet bear the load,
// to round-off times the condition.
TEST(IllConditioned, IsSolvedWhereTheBackwardErrorIsRoundOff) {
  const auto comm = Tpetra::getDefaultComm();
  const auto grid = std::make_shared<SpringGrid>(comm, 9, 9);
  constexpr double foot = 1e-10;
  const auto matrix = weakly_held(grid, foot);
  const auto b = loads(*grid);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::mumps);
  solver->set_matrix(matrix, true, {});
  EXPECT_EQ(failure_of(*solver, *b, x), "");
  double mine[2] = {0.0, 0.0}, all[2];  // borne, loaded; in the first direction
  for (const int node : grid->owned_nodes()) {
    const LocalOrdinal row = grid->dofs->getLocalElement(grid->dof(node, 0));
    if (node < grid->nx()) mine[0] += foot * x.getLocalViewHost(Tpetra::Access::ReadOnly)(row, 0);
    mine[1] += b->getLocalViewHost(Tpetra::Access::ReadOnly)(row, 0);
  }
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, 2, mine, all);
  EXPECT_NEAR(all[0], all[1], 1e-3 * std::abs(all[1]));
}

// Feet below round-off are no feet: the backward error of what the factors give is small, but no digit of it is right.
TEST(Singular, IsRefusedThoughItsBackwardErrorIsSmall) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 9, 9);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::mumps);
  for (const double foot : {1e-18, 1e-17}) {
    solver->set_matrix(weakly_held(grid, foot), true, {});
    const std::string message = failure_of(*solver, *loads(*grid), x);
    EXPECT_NE(message.find("singular"), std::string::npos) << message;
  }
}

// A right-hand side in the range of a singular matrix has solutions. If the factorisation meets no zero pivot, one of them is returned.
TEST(Singular, WithAConsistentRightHandSideIsRefusedOrSolved) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 9, 9);
  const auto matrix = weakly_held(grid, 0.0);
  Vector b(grid->dofs), x(grid->dofs);
  matrix->apply(*loads(*grid), b);
  const auto solver = solver_of(Kind::mumps);
  solver->set_matrix(matrix, true, {});
  const std::string message = failure_of(*solver, b, x);
  RecordProperty("message", message);
  if (message.empty())
    EXPECT_LE(true_residual(*matrix, b, x), 1e-8);
  else
    EXPECT_NE(message.find("singular"), std::string::npos) << message;
}

TEST(NotFinite, IsAStepFailure) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 5, 5);
  Vector x(grid->dofs);
  const auto b = loads(*grid);
  for (const Kind kind : {Kind::mumps, Kind::iterative}) {
    const auto solver = solver_of(kind);
    const auto broken = stiffness(grid, true);
    broken->resumeFill();
    if (grid->dofs->isNodeGlobalElement(grid->dof(12, 0)))  // on one rank
      broken->getLocalMatrixHost().row(grid->dofs->getLocalElement(grid->dof(12, 0))).value(0) = std::nan("");
    broken->fillComplete(grid->dofs, grid->dofs);
    solver->set_matrix(broken, true, {[&] { return grid->near_null_space(); }, {}});
    EXPECT_NE(failure_of(*solver, *b, x).find("not finite"), std::string::npos);
    Vector nan(*b, Teuchos::Copy);
    if (grid->dofs->isNodeGlobalElement(grid->dof(12, 0))) nan.replaceGlobalValue(grid->dof(12, 0), std::nan(""));
    solver->set_matrix(stiffness(grid, true), true, {[&] { return grid->near_null_space(); }, {}});
    EXPECT_NE(failure_of(*solver, nan, x).find("not finite"), std::string::npos);
  }
}

TEST(ZeroRightHandSide, HasTheZeroSolution) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 5, 5);
  for (const Kind kind : {Kind::mumps, Kind::iterative}) {
    const auto solver = solver_of(kind);
    Vector b(grid->dofs), x(grid->dofs);
    x.putScalar(1.0);
    solver->set_matrix(stiffness(grid, true), true, {[&] { return grid->near_null_space(); }, {}});
    solver->solve(b, x);
    EXPECT_EQ(x.norm2(), 0.0);
  }
}

TEST(Klu2, RunsOnOneRankAndIsRefusedOnMore) {
  if (Tpetra::getDefaultComm()->getSize() > 1) {
    EXPECT_THROW(solver_of(Kind::klu2), InputError);
    return;
  }
  for (const Numbering numbering : {Numbering::blocks, Numbering::with_gaps}) {
    SCOPED_TRACE(static_cast<int>(numbering));
    const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 13, 9, numbering);
    const auto b = loads(*grid);
    Vector x(grid->dofs);
    const auto solver = solver_of(Kind::klu2);
    for (const double scale : {1.0, 3.0}) {
      SCOPED_TRACE(scale);
      const auto matrix = stiffness(grid, true, scale);
      solver->set_matrix(matrix, scale == 1.0, {});
      EXPECT_EQ(failure_of(*solver, *b, x), "");
      EXPECT_LE(true_residual(*matrix, *b, x), 1e-12);
      EXPECT_EQ(solver->symbolic_setups(), 1);
    }
    const auto zero = rcp(new Matrix(grid->graph));
    zero->fillComplete(grid->dofs, grid->dofs);
    solver->set_matrix(zero, false, {});
    EXPECT_NE(failure_of(*solver, *b, x), "");
  }
}

}  // namespace
}  // namespace mortise
