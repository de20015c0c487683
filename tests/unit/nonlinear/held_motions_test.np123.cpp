// Motions that nothing holds and nothing drives are left out of Newton's steps.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Tpetra_Core.hpp>

#include "mortise/nonlinear/newton_solver.hpp"
#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Problem;
using test::SpringGrid;

/// The rigid motions of the upper body, which contact does not touch.
class UpperBody {
 public:
  UpperBody(const SpringGrid& grid, const Communicator& comm) : grid_(grid), comm_(comm) {}

  HeldMotions held(const RCP<const Vector>& d) const {
    HeldMotions held;
    const int left = grid_.cut() * grid_.nx(), right = left + grid_.nx() - 1;
    for (const GlobalOrdinal id : {grid_.dof(left, 0), grid_.dof(left, 1), grid_.dof(right, 1)})
      if (const LocalOrdinal dof = grid_.dofs->getLocalElement(id); dof >= 0) held.dofs.push_back(dof);
    std::sort(held.dofs.begin(), held.dofs.end());
    const auto at = rcp(new Vector(*d, Teuchos::Copy));
    held.take_out = [this, at](Vector& dd) {
      const Eigen::Vector3d q = fit(*at, dd);
      each(*at, [&](LocalOrdinal dof, const Eigen::Vector3d& motion) { dd.sumIntoLocalValue(dof, -motion.dot(q)); });
    };
    return held;
  }

  /// The rigid motion nearest to a change of displacement: of its middle, and the rotation about it.
  Eigen::Vector3d fit(const Vector& d, const Vector& dd) const {
    const auto values = dd.getLocalViewHost(Tpetra::Access::ReadOnly);
    Eigen::Matrix<double, 3, 4> mine = Eigen::Matrix<double, 3, 4>::Zero(), all = mine;
    each(d, [&](LocalOrdinal dof, const Eigen::Vector3d& motion) {
      mine.leftCols<3>() += motion * motion.transpose();
      mine.col(3) += values(dof, 0) * motion;
    });
    Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, 12, mine.data(), all.data());
    return all.leftCols<3>().eval().fullPivLu().solve(all.col(3));
  }

 private:
  template <class Visit>
  void each(const Vector& d, const Visit& visit) const {
    std::vector<std::array<double, 2>> positions;
    {
      const auto u = d.getLocalViewHost(Tpetra::Access::ReadOnly);
      for (std::size_t n = 0; n < grid_.owned_nodes().size(); ++n) {
        const auto X = grid_.position(grid_.owned_nodes()[n]);
        positions.push_back({X[0] + u(2 * n, 0) - 2.77, X[1] + u(2 * n + 1, 0) - 3.0});
      }
    }
    for (std::size_t n = 0; n < positions.size(); ++n) {
      if (grid_.owned_nodes()[n] / grid_.nx() < grid_.cut()) continue;
      visit(static_cast<LocalOrdinal>(2 * n), {1.0, 0.0, -positions[n][1]});
      visit(static_cast<LocalOrdinal>(2 * n + 1), {0.0, 1.0, positions[n][0]});
    }
  }

  const SpringGrid& grid_;
  const Communicator& comm_;
};

/// With each kind of solver.
class HeldMotionsOf : public ::testing::TestWithParam<LinearSolverOptions::Kind> {};
INSTANTIATE_TEST_SUITE_P(Solvers, HeldMotionsOf, ::testing::Values(LinearSolverOptions::Kind::mumps, LinearSolverOptions::Kind::iterative));

// A body in the air, strained and let go, springs back where it is: its middle stays, to round-off, and the last step of Newton's method squares the
// residual.
TEST_P(HeldMotionsOf, ABodyInTheAirSpringsBackWhereItIs) {
  Problem::Choices choices;
  choices.nx = 6;
  choices.ny = 7;
  choices.cut = 3;
  choices.linear_solver.kind = {GetParam(), {}};
  choices.linear_solver.largest_tolerance = 1e-10;
  const auto comm = Tpetra::getDefaultComm();
  Problem problem(comm, choices);
  const SpringGrid& grid = *problem.grid;
  SystemParts parts = problem.system->parts();
  const UpperBody body(grid, *comm);
  parts.held_motions = [&](const SystemEvaluation& at) { return std::optional(body.held(problem.system->unknowns(at.x()))); };
  const SemiSmoothSystem system(std::move(parts), Timers());

  Vector x(system.map());
  for (const int node : grid.owned_nodes()) {
    if (node / grid.nx() < grid.cut()) continue;
    const auto X = grid.position(node);
    x.replaceGlobalValue(grid.dof(node, 0), 0.03 * std::sin(1.3 * X[0]) + 0.02 * X[1]);
    x.replaceGlobalValue(grid.dof(node, 1), 0.7 + 0.02 * std::cos(0.7 * X[0] * X[1]));
  }
  const StepContext context = system.step_from(system.initial_state(x), 1.0);
  NewtonReport report;
  const SystemEvaluation found = solve_newton(system, system.evaluate(x, context), {}, report, {});
  EXPECT_LE(report.newton_steps(), 6);
  EXPECT_LE(found.norms().momentum_absolute, 1e-14);
  Vector change(*system.unknowns(found.x()), Teuchos::Copy);
  change.update(-1.0, *system.unknowns(std::as_const(x)), 1.0);
  EXPECT_GT(change.norm2(), 0.05);
  double sums[2] = {0.0, 0.0}, all[2];
  {
    const auto values = change.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t n = 0; n < grid.owned_nodes().size(); ++n)
      for (int i = 0; i < 2 && grid.owned_nodes()[n] / grid.nx() >= grid.cut(); ++i) sums[i] += values(2 * n + i, 0);
  }
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, 2, sums, all);
  EXPECT_LE(std::hypot(all[0], all[1]), 1e-12);
}

}  // namespace
}  // namespace mortise
