// Conditions along any directions at a node, solved for components.
#include "constraints/node_conditions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace mortise {
namespace {

/// n_m . d for a d that the solved components make of the free ones and of g.
Eigen::VectorXd evaluated(const Eigen::MatrixXd& normals, const SolvedConditions& solved, const Eigen::VectorXd& g, Eigen::VectorXd d) {
  for (const auto& one : solved.components) d[one.component] = 0.0;
  Eigen::VectorXd result = d;
  for (const auto& one : solved.components) result[one.component] = one.of.dot(d) + one.weights.dot(g);
  return normals * result;
}

TEST(NodeConditions, HoldForAnyNumberOfDirections) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const Eigen::Index dimension : {2, 3})
    for (Eigen::Index count = 1; count <= dimension; ++count)
      for (int round = 0; round < 50; ++round) {
        Eigen::MatrixXd normals(count, dimension);
        Eigen::VectorXd g(count), d(dimension);
        for (Eigen::Index m = 0; m < count; ++m) {
          for (Eigen::Index i = 0; i < dimension; ++i) normals(m, i) = normal(random);
          normals.row(m).normalize();
          g[m] = normal(random);
        }
        for (Eigen::Index i = 0; i < dimension; ++i) d[i] = normal(random);
        const SolvedConditions solved = solve_conditions(normals);
        ASSERT_EQ(static_cast<Eigen::Index>(solved.components.size()), count);
        EXPECT_TRUE(solved.checks.empty());
        const double condition = 1.0 / normals.jacobiSvd().singularValues().minCoeff();
        EXPECT_LE((evaluated(normals, solved, g, d) - g).norm(), 1e-14 * condition * condition) << normals;
      }
}

TEST(NodeConditions, SayWhatRedundantDirectionsHaveToAgreeOn) {
  Eigen::MatrixXd normals(3, 2);
  normals << 1, 0, 0, 1, std::sqrt(0.5), std::sqrt(0.5);
  const SolvedConditions solved = solve_conditions(normals);
  ASSERT_EQ(solved.components.size(), 2u);
  ASSERT_EQ(solved.checks.size(), 1u);
  const Eigen::Vector2d d(0.3, -0.7);
  EXPECT_NEAR(solved.checks[0].dot(normals * d), 0.0, 1e-15);
  EXPECT_GT(std::abs(solved.checks[0].dot(Eigen::Vector3d(0.3, -0.7, 1.0))), 0.1);
}

TEST(NodeConditions, AlongAxesLeaveNothingOfOtherComponents) {
  Eigen::MatrixXd normals(2, 3);
  normals << 0, 1, 0, 1e-17, 6e-17, 1;  // cos(90 degrees)
  const SolvedConditions solved = solve_conditions(normals);
  ASSERT_EQ(solved.components.size(), 2u);
  for (const auto& one : solved.components) EXPECT_TRUE(one.of.isZero(0.0)) << one.of;
  EXPECT_EQ(solved.components[0].component, 1);
  EXPECT_EQ(solved.components[1].component, 2);
}

}  // namespace
}  // namespace mortise
