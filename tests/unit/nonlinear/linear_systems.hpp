#pragma once
// Systems to solve and solvers for tests of linear solvers.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>
#include <string>

#include "mortise/core/trilinos_versions.hpp"
#include "spring_grid.hpp"

namespace mortise::test {

using Kind = LinearSolverOptions::Kind;

// K of the springs plus a skew part, so that the matrix is not symmetric; the nodes of the lower edge are fixed if `held`.
inline RCP<Matrix> stiffness(const std::shared_ptr<SpringGrid>& grid, bool held, double scale = 1.0, double skewness = 0.1) {
  const auto matrix = rcp(new Matrix(grid->graph));
  Vector zero(grid->dofs), local_zero(grid->local_dofs);
  std::optional<StepFailure> failure;
  Springs(grid, scale).add_jacobian({0.0, zero, local_zero}, {}, *matrix, failure);
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

inline RCP<Vector> loads(const SpringGrid& grid) {
  const auto b = rcp(new Vector(grid.dofs));
  for (const GlobalOrdinal id : local_ids(*grid.dofs)) b->replaceGlobalValue(id, std::sin(0.7 * id) + 0.3);
  return b;
}

inline double true_residual(const Matrix& matrix, const Vector& b, const Vector& x) {
  Vector r(b, Teuchos::Copy);
  matrix.apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  return r.norm2() / b.norm2();
}

// The iterative one coarsens small grids too, as it would large ones; coarse levels of so many rows or more on each rank are shared.
inline std::unique_ptr<LinearSolver> solver_of(Kind kind, double tolerance = 1e-10, int iterations = 500, int shared_from = 5000) {
  LinearSolverOptions options;
  options.kind.value = kind;
  options.tolerance = tolerance;
  options.maximum_iterations = iterations;
  options.muelu.value.set("coarse: max size", 100);
  options.muelu.value.set("repartition: min rows per proc", shared_from);
  return make_linear_solver(options, Tpetra::getDefaultComm(), Timers());
}

inline std::string failure_of(LinearSolver& solver, const Vector& b, Vector& x) {
  try {
    solver.solve(b, x);
  } catch (const StepFailure& failure) {
    EXPECT_EQ(failure.kind(), FailureKind::linear_solver);
    return failure.what();
  }
  return {};
}

}  // namespace mortise::test
