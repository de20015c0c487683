// F, its derivative, forces and the Newton direction, without contact.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

#include "mortise/core/trilinos_versions.hpp"
#include "spring_grid.hpp"

namespace mortise {
namespace {

using test::Problem;

Problem::Choices pulled() {
  Problem::Choices choices;
  choices.force = {0.02, 0.05};
  choices.motion = {0.4, -0.3};
  return choices;
}

void fill(Vector& x, double amplitude, double frequency) {
  for (const GlobalOrdinal id : local_ids(*x.getMap())) x.replaceGlobalValue(id, amplitude * std::sin(frequency * id + 0.4));
}

TEST(System, WithoutContactItsMapIsThatOfTheDofs) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  EXPECT_TRUE(problem.system->map()->isSameAs(*problem.grid->dofs));
  EXPECT_EQ(problem.system->multipliers(*problem.x)->getGlobalLength(), 0u);
  problem.system->unknowns(*problem.x)->putScalar(2.0);
  EXPECT_EQ(problem.x->normInf(), 2.0);
}

TEST(System, JacobianAgreesWithCentralDifferences) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  SemiSmoothSystem& system = *problem.system;
  const StepContext context = problem.context(0.7);
  Vector v(system.map()), J_v(system.map()), difference(system.map());
  fill(*problem.x, 0.1, 0.37);
  fill(v, 1.0, 0.91);
  const double h = 1e-6;
  for (const double sign : {1.0, -1.0}) {
    Vector x(*problem.x, Teuchos::Copy);
    x.update(sign * h, v, 1.0);
    difference.update(sign / (2.0 * h), system.evaluate(x, context).residual(), 1.0);
  }
  system.linearise(system.evaluate(*problem.x, context)).apply(v, J_v);
  const double size = J_v.norm2();
  difference.update(-1.0, J_v, 1.0);
  EXPECT_GT(size, 0.0);
  EXPECT_LE(difference.norm2(), 1e-6 * size);
}

// J dx + F = 0, also on the prescribed rows; the direction may be asked for twice, and J is not harmed by it.
TEST(System, DirectionSolvesTheLinearisedSystem) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  SemiSmoothSystem& system = *problem.system;
  fill(*problem.x, 0.05, 0.37);
  Vector direction(system.map()), again(system.map()), J_dx(system.map());
  const SystemEvaluation at = problem.evaluate(1.0);
  const Vector& F = at.residual();
  const SystemLinearisation linearisation = system.linearise(at);
  linearisation.newton_direction(F, direction);
  linearisation.apply(direction, J_dx);
  J_dx.update(1.0, F, 1.0);
  EXPECT_LE(J_dx.norm2(), 1e-12 * F.norm2());
  linearisation.newton_direction(F, again);
  again.update(-1.0, direction, 1.0);
  EXPECT_LE(again.norm2(), 1e-12 * direction.norm2());  // on several ranks MUMPS sums in the order in which messages arrive

  Vector x(*problem.x, Teuchos::Copy);
  x.update(1.0, direction, 1.0);
  EXPECT_LE(system.evaluate(x, at.context()).norms().prescribed, 1e-15);
}

TEST(System, NormsAreThoseOfTheirDefinitions) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  ResidualNorms norms = problem.evaluate(0.0).norms();  // nothing moved, nothing prescribed
  EXPECT_EQ(norms.momentum, 0.0);
  EXPECT_EQ(norms.prescribed, 0.0);
  EXPECT_TRUE(norms.finite);

  const SystemEvaluation at_rest = problem.evaluate(1.0);  // r is the load on the six nodes of the upper edge, which is all prescribed
  norms = at_rest.norms();
  EXPECT_EQ(norms.momentum, 0.0);
  EXPECT_DOUBLE_EQ(norms.prescribed, 0.4 / 5);
  EXPECT_NEAR(at_rest.forces()->norm2(), std::sqrt(6.0 * (0.02 * 0.02 + 0.05 * 0.05)), 1e-15);

  Problem::Choices free = pulled();
  free.motion.reset();
  Problem loaded(Tpetra::getDefaultComm(), free);
  EXPECT_DOUBLE_EQ(loaded.evaluate(1.0).norms().momentum, 1.0);  // all of |f_ext| is out of balance
}

TEST(System, ARigidMotionIsInEquilibrium) {
  Problem problem(Tpetra::getDefaultComm(), {});
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (const int node : problem.grid->owned_nodes()) {
    const auto x = problem.grid->position(node);
    problem.x->replaceGlobalValue(problem.grid->dof(node, 0), c * x[0] - s * x[1] - x[0]);
    problem.x->replaceGlobalValue(problem.grid->dof(node, 1), s * x[0] + c * x[1] - x[1]);
  }
  EXPECT_LE(problem.evaluate(0.0).norms().momentum, 1e-9);  // f_int is round-off and is not measured against itself
}

TEST(System, AFailureOnOneRankIsThrownOnAll) {
  Problem::Choices choices;
  choices.reach = 0.5;
  Problem problem(Tpetra::getDefaultComm(), choices);
  const GlobalOrdinal id = problem.grid->dof(7, 1);
  if (problem.grid->dofs->isNodeGlobalElement(id)) problem.x->replaceGlobalValue(id, 0.6);
  EXPECT_THROW(problem.evaluate(0.0), StepFailure);
}

TEST(System, NotFiniteIsSeenOnAllRanks) {
  Problem problem(Tpetra::getDefaultComm(), {});
  problem.evaluate(0.0);
  const GlobalOrdinal id = problem.grid->dof(7, 1);
  if (problem.grid->dofs->isNodeGlobalElement(id)) problem.x->replaceGlobalValue(id, std::nan(""));
  EXPECT_FALSE(problem.evaluate(0.0).norms().finite);
}

}  // namespace
}  // namespace mortise
