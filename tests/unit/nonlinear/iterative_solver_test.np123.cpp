// Krylov's method with multigrid: iterations, smoothers, what is refused.

#include <gtest/gtest.h>

#include "linear_systems.hpp"

namespace mortise {
namespace {

using namespace test;

// The number of iterations of multigrid does not depend on the size of the grid. It may double at most, while the number of unknowns grows
// sixteenfold (that of GMRES alone would grow fourfold).
TEST(Iterative, SolvesInAboutAsManyIterationsOnFinerGrids) {
  std::vector<int> iterations;
  for (const int n : {24, 96}) {
    const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), n, n, Numbering::blocks);
    const auto matrix = stiffness(grid, true, 1.0, 0.0);
    const auto b = loads(*grid);
    Vector x(grid->dofs);
    const auto solver = solver_of(Kind::iterative);
    solver->set_matrix(matrix, true, {[&] { return grid->near_null_space(); }, {}});
    const LinearSolveReport report = solver->solve(*b, x);
    EXPECT_LE(true_residual(*matrix, *b, x), 1e-9);
    EXPECT_GT(report.iterations, 0);
    iterations.push_back(report.iterations);
    RecordProperty("iterations_" + std::to_string(n), report.iterations);
  }
  EXPECT_LE(iterations[1], 2 * iterations[0]);
}

// Of one and the same system, one solve after the other.
std::vector<int> iterations_of_two_solves(LinearSolver& solver, const std::shared_ptr<SpringGrid>& grid) {
  const auto matrix = stiffness(grid, true);
  const auto b = loads(*grid);
  std::vector<int> iterations;
  for (int solve = 0; solve < 2; ++solve) {
    Vector x(grid->dofs);
    solver.set_matrix(matrix, solve == 0, {[&] { return grid->near_null_space(); }, {}});
    iterations.push_back(solver.solve(*b, x).iterations);
    EXPECT_LE(true_residual(*matrix, *b, x), 1e-9);
  }
  return iterations;
}

// The skew part couples neighbours by a first difference, which outweighs the second differences of springs on coarse levels. Eigenvalues are far
// from real there, and Chebyshev polynomials make errors grow. The first solve finds that out; those that follow use Gauss-Seidel.
TEST(Iterative, TakesAnotherSmootherWhereEigenvaluesAreFarFromReal) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 96, 96, Numbering::blocks);
  const auto solver = solver_of(Kind::iterative);
  const std::vector<int> iterations = iterations_of_two_solves(*solver, grid);
  EXPECT_GE(iterations[0], 100 + iterations[1]);
  EXPECT_LE(iterations[1], 50);
}

TEST(Iterative, SharesLargeCoarseLevelsAmongRanks) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 96, 96, Numbering::blocks);
  const auto matrix = stiffness(grid, true, 1.0, 0.0);
  const auto b = loads(*grid);
  const auto iterations = [&](int shared_from) {
    Vector x(grid->dofs);
    const auto solver = solver_of(Kind::iterative, 1e-10, 500, shared_from);
    solver->set_matrix(matrix, true, {[&] { return grid->near_null_space(); }, {}});
    const LinearSolveReport report = solver->solve(*b, x);
    EXPECT_LE(true_residual(*matrix, *b, x), 1e-9);
    return report.iterations;
  };
  EXPECT_LE(iterations(500), 1.5 * iterations(100000));
}

// The tolerance of a solve is used where it is looser than that of the options: fewer iterations, and a residual that keeps to it.
TEST(Iterative, StopsAtTheToleranceOfTheSolve) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 48, 48, Numbering::blocks);
  const auto matrix = stiffness(grid, true, 1.0, 0.0);
  const auto b = loads(*grid);
  const auto solver = solver_of(Kind::iterative, 1e-10);
  solver->set_matrix(matrix, true, {[&] { return grid->near_null_space(); }, {}});
  std::vector<int> iterations;
  for (const double tolerance : {1e-2, 1e-10}) {
    SCOPED_TRACE(tolerance);
    Vector x(grid->dofs);
    iterations.push_back(solver->solve(*b, x, tolerance).iterations);
    EXPECT_LE(true_residual(*matrix, *b, x), 10.0 * tolerance);
  }
  EXPECT_GT(iterations[0], 0);
  EXPECT_LT(iterations[0], iterations[1]);
}

TEST(Iterative, WorksWithoutCoordinatesAndModes) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 12, 12, Numbering::scattered);
  const auto matrix = stiffness(grid, true);
  const auto b = loads(*grid);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::iterative);
  solver->set_matrix(matrix, true, {});
  solver->solve(*b, x);
  EXPECT_LE(true_residual(*matrix, *b, x), 1e-9);
}

TEST(Iterative, GivesUpWithAStepFailure) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 24, 24, Numbering::blocks);
  Vector x(grid->dofs);
  const auto solver = solver_of(Kind::iterative, 1e-12, 2);
  solver->set_matrix(stiffness(grid, true), true, {[&] { return grid->near_null_space(); }, {}});
  EXPECT_NE(failure_of(*solver, *loads(*grid), x).find("the true relative residual"), std::string::npos);
}

// Gauss-Seidel alone leaves GMRES so many iterations that it restarts. With as many vectors as `basis` says (none: as the solver decides): the
// iterations of two solves, one after the other.
std::vector<int> iterations_of_two_solves(std::optional<int> basis) {
  LinearSolverOptions options;
  options.kind.value = Kind::iterative;
  options.muelu.value.set("max levels", 1);
  options.muelu.value.set("smoother: type", "RELAXATION");
  options.muelu.value.set("coarse: type", "RELAXATION");
  options.muelu.value.sublist("coarse: params").set("relaxation: type", "Symmetric Gauss-Seidel");
  if (basis) options.belos.value.set("Num Blocks", *basis);
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 32, 32, Numbering::blocks);
  const auto solver = make_linear_solver(options, Tpetra::getDefaultComm(), Timers());
  return iterations_of_two_solves(*solver, grid);
}

// A restart forgets the space searched so far. The first system meets a small basis; the next one has room for what the first one took.
TEST(Iterative, RestartsLaterOnceASystemTookManyIterations) {
  const auto itself = iterations_of_two_solves({}), small = iterations_of_two_solves(50), large = iterations_of_two_solves(200);
  ASSERT_GT(large[0], 50);   // no basis of 50 could do without a restart,
  ASSERT_LE(large[0], 200);  // one of 200 does
  ASSERT_LT(large[1], small[1]);
  RecordProperty("iterations", std::to_string(small[1]) + " " + std::to_string(large[1]));
  EXPECT_EQ(itself[0], small[0]);
  EXPECT_EQ(itself[1], large[1]);
}

// MueLu's own smoother of all levels is symmetric Gauss-Seidel, so to ask for it on one of them is to ask for it on all.
TEST(Iterative, TakesASmootherForOneLevel) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 32, 32, Numbering::blocks);
  const auto iterations = [&](bool of_one_level) {
    LinearSolverOptions options;
    options.kind.value = Kind::iterative;
    options.muelu.value.set("coarse: max size", 100);
    (of_one_level ? options.muelu.value.sublist("level 1") : options.muelu.value).set("smoother: type", "RELAXATION");
    return iterations_of_two_solves(*make_linear_solver(options, Tpetra::getDefaultComm(), Timers()), grid);
  };
  EXPECT_EQ(iterations(true), iterations(false));
}

TEST(Iterative, RefusesParametersItsPackagesDoNotKnow) {
  LinearSolverOptions options;
  options.kind.value = Kind::iterative;
  options.muelu.value.set("max levels", 3);
  options.belos.value.set("Num Blocks", 30);
  EXPECT_NO_THROW(make_linear_solver(options, Tpetra::getDefaultComm(), Timers()));
  options.muelu.value.set("max levles", 3);
  options.belos.value.set("Num Blokcs", 30);
  try {
    make_linear_solver(options, Tpetra::getDefaultComm(), Timers());
    FAIL() << "unknown parameters were taken";
  } catch (const InputError& error) {
    ASSERT_EQ(error.diagnostics().size(), 2u);
    EXPECT_NE(error.diagnostics()[0].message.find("max levles"), std::string::npos);
    EXPECT_NE(error.diagnostics()[1].message.find("Num Blokcs"), std::string::npos);
  }
}

}  // namespace
}  // namespace mortise
