// When a hierarchy is rebuilt.
#include "multigrid/reuse_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace mortise::detail {
namespace {

// Solves of so many digits until the hierarchy is stale, at most 1000, if its k-th solve takes `iterations(k)`.
int life(const std::function<double(int)>& iterations, double digits) {
  ReusePolicy policy;
  int solves = 0;
  while (solves < 1000 && !policy.is_stale()) {
    policy.record(static_cast<int>(std::lround(iterations(solves))), digits);
    ++solves;
  }
  return solves;
}

// No new one would do better, however many iterations a digit takes.
TEST(ReusePolicy, KeepsAHierarchyWhileSolvesAreAllAlike) {
  for (const int iterations : {1, 7, 100}) EXPECT_EQ(life([=](int) { return iterations; }, 3.0), 1000) << iterations;
}

// The first solve with a hierarchy may be easy: 3 iterations, and 7 in each that follows.
TEST(ReusePolicy, KeepsAHierarchyAfterAnEasyFirstSolve) {
  EXPECT_EQ(life([](int solve) { return solve == 0 ? 3 : 7; }, 3.0), 1000);
}

// More iterations for more digits do not make it stale.
TEST(ReusePolicy, CountsByTheDigit) {
  ReusePolicy policy;
  for (int solve = 0; solve < 100; ++solve) {
    const int digits = 1 + solve % 10;
    policy.record(2 * digits, digits);
    ASSERT_FALSE(policy.is_stale()) << solve;
  }
}

// After many solves of 6 iterations the least average is near 6: one of 7 may be chance, a second one is not.
TEST(ReusePolicy, KeepsAHierarchyAfterASingleIterationMore) {
  ReusePolicy policy;
  for (int solve = 0; solve < 100; ++solve) policy.record(6, 3.0);
  policy.record(7, 3.0);
  EXPECT_FALSE(policy.is_stale());
  policy.record(7, 3.0);
  EXPECT_TRUE(policy.is_stale());
}

// i_k = a + g k, as far as a solve is let go, each of one digit. The least cost of a life of n solves, c = (S + sum i_k) / n, by trying all n. The
// hierarchy is stale after solves that took at most 1 + S beyond c, the last of them at most S: the life costs c + (1 + S) / n at most.
TEST(ReusePolicy, EndsALifeNearTheLeastCost) {
  constexpr double S = iterations_of_set_up;
  for (const double growth : {0.5, 1.0, 2.0, 5.0, 20.0})
    for (const double first : {2.0, 10.0}) {
      SCOPED_TRACE(::testing::Message() << growth << ' ' << first);
      const auto iterations = [=](int solve) { return std::floor(first + growth * solve); };
      const int solves = life(iterations, 1.0);
      double least = std::numeric_limits<double>::infinity(), sum = S, cost = 0.0;
      for (int solve = 0; solve < 100; ++solve) {
        sum += iterations(solve);
        least = std::min(least, sum / (solve + 1));
        if (solve + 1 == solves) cost = sum / solves;
      }
      ASSERT_GT(cost, 0.0);
      EXPECT_LE(cost, least + (1.0 + S) / solves);
    }
}

TEST(ReusePolicy, EndsASolveThatTakesASetUpMoreThanTheAverage) {
  ReusePolicy policy;
  EXPECT_EQ(policy.most_iterations(3.0), std::numeric_limits<double>::infinity());
  policy.record(6, 2.0);
  EXPECT_DOUBLE_EQ(policy.most_iterations(3.0), 3.0 * (iterations_of_set_up + 6.0) / 2.0 + iterations_of_set_up);
}

}  // namespace
}  // namespace mortise::detail
