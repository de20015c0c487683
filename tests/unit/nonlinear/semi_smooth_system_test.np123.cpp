// F, its derivative, forces and the Newton direction, without contact.

#include <gtest/gtest.h>

#include <Tpetra_Core.hpp>

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
  for (const GlobalOrdinal id : x.getMap()->getNodeElementList()) x.replaceGlobalValue(id, amplitude * std::sin(frequency * id + 0.4));
}

TEST(System, WithoutContactItsMapIsThatOfTheDofs) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  EXPECT_TRUE(problem.system->map()->isSameAs(*problem.grid->dofs));
  EXPECT_EQ(problem.system->multipliers(*problem.x)->getGlobalLength(), 0u);
  problem.system->displacement(*problem.x)->putScalar(2.0);
  EXPECT_EQ(problem.x->normInf(), 2.0);
}

TEST(System, JacobianAgreesWithCentralDifferences) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  SemiSmoothSystem& system = *problem.system;
  system.set_time(0.7);
  Vector v(system.map()), J_v(system.map()), difference(system.map()), F(system.map());
  fill(*problem.x, 0.1, 0.37);
  fill(v, 1.0, 0.91);
  ResidualNorms norms;
  const double h = 1e-6;
  for (const double sign : {1.0, -1.0}) {
    Vector x(*problem.x, Teuchos::Copy);
    x.update(sign * h, v, 1.0);
    system.residual(x, F, norms);
    difference.update(sign / (2.0 * h), F, 1.0);
  }
  system.jacobian(*problem.x);
  system.apply(v, J_v);
  const double size = J_v.norm2();
  difference.update(-1.0, J_v, 1.0);
  EXPECT_GT(size, 0.0);
  EXPECT_LE(difference.norm2(), 1e-6 * size);
}

// J dx + F = 0, also on the prescribed rows; the direction may be asked for twice, and J is not harmed by it.
TEST(System, DirectionSolvesTheLinearisedSystem) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  SemiSmoothSystem& system = *problem.system;
  system.set_time(1.0);
  fill(*problem.x, 0.05, 0.37);
  Vector F(system.map()), direction(system.map()), again(system.map()), J_dx(system.map());
  ResidualNorms norms;
  system.residual(*problem.x, F, norms);
  system.jacobian(*problem.x);
  system.newton_direction(F, direction);
  system.apply(direction, J_dx);
  J_dx.update(1.0, F, 1.0);
  EXPECT_LE(J_dx.norm2(), 1e-12 * F.norm2());
  system.newton_direction(F, again);
  again.update(-1.0, direction, 1.0);
  EXPECT_LE(again.norm2(), 1e-12 * direction.norm2());  // on several ranks MUMPS sums in the order in which messages arrive

  Vector x(*problem.x, Teuchos::Copy);
  x.update(1.0, direction, 1.0);
  system.residual(x, F, norms);
  EXPECT_LE(norms.prescribed, 1e-15);
}

TEST(System, NormsAreThoseOfTheirDefinitions) {
  Problem problem(Tpetra::getDefaultComm(), pulled());
  SemiSmoothSystem& system = *problem.system;
  Vector F(system.map()), force(system.map());
  ResidualNorms norms;
  system.set_time(0.0);
  system.residual(*problem.x, F, norms);  // nothing moved, nothing prescribed
  EXPECT_EQ(norms.momentum, 0.0);
  EXPECT_EQ(norms.prescribed, 0.0);
  EXPECT_TRUE(norms.finite);

  system.set_time(1.0);  // at rest: r is the load on the six nodes of the upper edge, which is all prescribed
  system.residual(*problem.x, F, norms);
  EXPECT_EQ(norms.momentum, 0.0);
  EXPECT_DOUBLE_EQ(norms.prescribed, 0.4 / 5);
  system.forces(*problem.x, force);
  EXPECT_NEAR(force.norm2(), std::sqrt(6.0 * (0.02 * 0.02 + 0.05 * 0.05)), 1e-15);

  Problem::Choices free = pulled();
  free.motion.reset();
  Problem loaded(Tpetra::getDefaultComm(), free);
  loaded.system->set_time(1.0);
  loaded.system->residual(*loaded.x, F, norms);  // all of |f_ext| is out of balance
  EXPECT_DOUBLE_EQ(norms.momentum, 1.0);
}

TEST(System, ARigidMotionIsInEquilibrium) {
  Problem problem(Tpetra::getDefaultComm(), {});
  SemiSmoothSystem& system = *problem.system;
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (const int node : problem.grid->owned_nodes()) {
    const auto x = problem.grid->position(node);
    problem.x->replaceGlobalValue(problem.grid->dof(node, 0), c * x[0] - s * x[1] - x[0]);
    problem.x->replaceGlobalValue(problem.grid->dof(node, 1), s * x[0] + c * x[1] - x[1]);
  }
  Vector F(system.map());
  ResidualNorms norms;
  system.residual(*problem.x, F, norms);
  EXPECT_LE(norms.momentum, 1e-9);  // f_int is round-off and is not measured against itself
}

TEST(System, AFailureOnOneRankIsThrownOnAll) {
  Problem::Choices choices;
  choices.reach = 0.5;
  Problem problem(Tpetra::getDefaultComm(), choices);
  const GlobalOrdinal id = problem.grid->dof(7, 1);
  if (problem.grid->dofs->isNodeGlobalElement(id)) problem.x->replaceGlobalValue(id, 0.6);
  Vector F(problem.system->map());
  ResidualNorms norms;
  EXPECT_THROW(problem.system->residual(*problem.x, F, norms), StepFailure);
}

TEST(System, NotFiniteIsSeenOnAllRanks) {
  Problem problem(Tpetra::getDefaultComm(), {});
  Vector F(problem.system->map());
  ResidualNorms norms;
  problem.system->residual(*problem.x, F, norms);
  const GlobalOrdinal id = problem.grid->dof(7, 1);
  if (problem.grid->dofs->isNodeGlobalElement(id)) problem.x->replaceGlobalValue(id, std::nan(""));
  problem.system->residual(*problem.x, F, norms);
  EXPECT_FALSE(norms.finite);
}

}  // namespace
}  // namespace mortise
