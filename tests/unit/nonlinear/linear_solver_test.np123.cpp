// Linear solvers: the true residual on any number of ranks, what is reused, what is refused.

#include <gtest/gtest.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>

#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Numbering;
using test::SpringGrid;
using Kind = LinearSolverOptions::Kind;

// K of the springs plus a skew part, so that the matrix is not symmetric; the nodes of the lower edge are fixed if `held`.
RCP<Matrix> stiffness(const std::shared_ptr<SpringGrid>& grid, bool held, double scale = 1.0, double skewness = 0.1) {
  const auto matrix = rcp(new Matrix(grid->graph));
  Vector zero(grid->dofs), local_zero(grid->local_dofs);
  std::optional<StepFailure> failure;
  test::Springs(grid, scale).add_jacobian({0.0, zero, local_zero}, *matrix, failure);
  for (const int node : grid->owned_nodes())
    for (const int other : grid->neighbours(node)) {
      const double skew = skewness * scale * (node < other ? 1.0 : -1.0);
      const GlobalOrdinal column = grid->dof(other, 1);
      matrix->sumIntoGlobalValues(grid->dof(node, 0), 1, &skew, &column);
      const GlobalOrdinal other_column = grid->dof(other, 0);
      matrix->sumIntoGlobalValues(grid->dof(node, 1), 1, &skew, &other_column);
    }
  if (held)
    for (const int node : grid->owned_nodes()) {
      if (node >= grid->nx()) continue;
      for (int i = 0; i < 2; ++i) {
        const LocalOrdinal row = grid->dofs->getLocalElement(grid->dof(node, i));
        const auto local = matrix->getLocalMatrixHost().row(row);
        for (LocalOrdinal k = 0; k < local.length; ++k)
          local.value(k) = matrix->getColMap()->getGlobalElement(local.colidx(k)) == grid->dof(node, i) ? scale : 0.0;
      }
    }
  matrix->fillComplete(grid->dofs, grid->dofs);
  return matrix;
}

RCP<Vector> loads(const SpringGrid& grid) {
  const auto b = rcp(new Vector(grid.dofs));
  for (const GlobalOrdinal id : grid.dofs->getNodeElementList()) b->replaceGlobalValue(id, std::sin(0.7 * id) + 0.3);
  return b;
}

double true_residual(const Matrix& matrix, const Vector& b, const Vector& x) {
  Vector r(b, Teuchos::Copy);
  matrix.apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  return r.norm2() / b.norm2();
}

// The iterative one coarsens small grids too, as it would large ones; coarse levels of so many rows or more on each rank are shared.
std::unique_ptr<LinearSolver> solver_of(Kind kind, double tolerance = 1e-10, int iterations = 500, int shared_from = 5000) {
  LinearSolverOptions options;
  options.kind.value = kind;
  options.tolerance = tolerance;
  options.maximum_iterations = iterations;
  options.muelu.value.set("coarse: max size", 100);
  options.muelu.value.set("repartition: min rows per proc", shared_from);
  return make_linear_solver(options, Tpetra::getDefaultComm(), Timers());
}

std::string failure_of(LinearSolver& solver, const Vector& b, Vector& x) {
  try {
    solver.solve(b, x);
  } catch (const StepFailure& failure) {
    EXPECT_EQ(failure.kind(), FailureKind::linear_solver);
    return failure.what();
  }
  return {};
}

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
  test::Springs(grid, 1.0).add_jacobian({0.0, x, local_zero}, *floating, failure);
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
  test::Springs(grid, 1.0).add_jacobian({0.0, zero, local_zero}, *matrix, failure);
  for (const int node : grid->owned_nodes())
    for (int i = 0; node < grid->nx() && i < 2; ++i) {
      const GlobalOrdinal id = grid->dof(node, i);
      matrix->sumIntoGlobalValues(id, 1, &foot, &id);
    }
  matrix->fillComplete(grid->dofs, grid->dofs);
  return matrix;
}

// The condition is some 1e12, so that |b - A x| / |b| stays far above 1e-8 however well the system is solved. What the feet bear is what is loaded,
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

// A right-hand side in the range of a singular matrix has solutions. What is returned, if the factorisation meets no zero pivot, is one of them.
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

// The number of iterations of multigrid does not depend on the size of the grid: it may double at most, while the number of unknowns grows
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

// The skew part couples neighbours by a first difference, which outweighs the second differences of springs on coarse levels: eigenvalues are far
// from real there, and Chebyshev polynomials make errors grow. The first solve finds that out, those that follow are Gauss-Seidel's.
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
