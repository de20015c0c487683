// The iterative solver that gives way to a direct one.

#include "selection/automatic_solver.hpp"

#include <gtest/gtest.h>

#include "linear_systems.hpp"

namespace mortise {
namespace {

using namespace test;

// Counts solves; takes so many iterations, or fails.
class Counting : public LinearSolver {
 public:
  explicit Counting(int iterations) : iterations_(iterations) {}
  std::string name() const override { return "counting"; }
  int symbolic_setups() const override { return 0; }
  void set_matrix(const RCP<const Matrix>&, bool graph_changed, const MultigridInput&) override { new_graphs += graph_changed ? 1 : 0; }
  LinearSolveReport solve(const Vector&, Vector&, double) override {
    ++solves;
    if (fails) throw StepFailure(failure, "counting: failed");
    return {iterations_, 0.0};
  }
  int solves = 0, new_graphs = 0;
  bool fails = false;
  FailureKind failure = FailureKind::linear_solver;

 private:
  int iterations_;
};

// A solver with those two, of which a test sees what they did.
struct Pair {
  explicit Pair(int iterations, double most) {
    auto one = std::make_unique<Counting>(iterations), other = std::make_unique<Counting>(0);
    iterative = one.get();
    direct = other.get();
    solver = detail::make_automatic_solver(std::move(one), std::move(other), most);
  }
  void solve(int matrices, bool graph_changed = false) {
    const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 3, 3, Numbering::blocks);
    const auto b = loads(*grid);
    Vector x(grid->dofs);
    for (int i = 0; i < matrices; ++i) {
      solver->set_matrix({}, graph_changed, {});
      solver->solve(*b, x);
    }
  }
  Counting *iterative, *direct;
  std::unique_ptr<LinearSolver> solver;
};

TEST(AutomaticSolver, StaysIterativeWhereThatIsFast) {
  Pair pair(50, 50.0);
  pair.solve(100);
  EXPECT_EQ(pair.iterative->solves, 100);
  EXPECT_EQ(pair.direct->solves, 0);
}

// One trial, 20 matrices directly, one trial, 40 matrices: 1 + 19 + 1 + 39 + 1 of 61, as the matrix of a trial is the first of those that follow.
TEST(AutomaticSolver, TriesAgainAfterTwiceAsManyMatrices) {
  Pair pair(51, 50.0);
  pair.solve(1);
  EXPECT_EQ(pair.direct->solves, 0);
  pair.solve(60);
  EXPECT_EQ(pair.iterative->solves, 3);
  EXPECT_EQ(pair.direct->solves, 58);
}

// A system whose solve failed is solved directly at once; a pattern that changed before is new to the direct solver.
TEST(AutomaticSolver, SolvesDirectlyWhatTheOtherCannot) {
  Pair pair(10, 50.0);
  pair.solve(2, true);
  pair.iterative->fails = true;
  pair.solve(1, false);
  EXPECT_EQ(pair.direct->solves, 1);
  EXPECT_EQ(pair.direct->new_graphs, 1);
  pair.solve(1, false);
  EXPECT_EQ(pair.direct->new_graphs, 1);
}

TEST(AutomaticSolver, GoesOnWithoutMemoryForFactors) {
  Pair pair(51, 50.0);
  pair.direct->fails = true;
  pair.direct->failure = FailureKind::out_of_memory;
  pair.solve(30);
  EXPECT_EQ(pair.iterative->solves, 30);
  EXPECT_EQ(pair.direct->solves, 1);
}

TEST(AutomaticSolver, BeginsAnewWhenItForgets) {
  Pair pair(51, 50.0);
  pair.solve(3);
  pair.solver->forget();
  pair.solve(1);
  EXPECT_EQ(pair.iterative->solves, 2);
}

// The solvers as they are: one that may take no iteration on a system that it could solve, then the direct one.
TEST(AutomaticSolver, SolvesToRoundOffOnceItIsDirect) {
  const auto grid = std::make_shared<SpringGrid>(Tpetra::getDefaultComm(), 24, 24, Numbering::blocks);
  const auto matrix = stiffness(grid, true, 1.0, 0.0);
  const auto b = loads(*grid);
  const auto solver = detail::make_automatic_solver(solver_of(Kind::iterative, 1e-6), solver_of(Kind::mumps), 0.0);
  Vector x(grid->dofs);
  for (int solve = 0; solve < 3; ++solve) {
    solver->set_matrix(matrix, solve == 0, {[&] { return grid->near_null_space(); }, {}});
    EXPECT_EQ(solver->solve(*b, x).iterations > 0, solve == 0);
    EXPECT_LE(true_residual(*matrix, *b, x), solve == 0 ? 1e-5 : 1e-12);
  }
}

}  // namespace
}  // namespace mortise
