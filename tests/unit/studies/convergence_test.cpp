// Orders, limits, times to an accuracy and Pareto fronts of sequences that are known in closed form.

#include "mortise/studies/convergence.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace mortise {
namespace {

using ::testing::ElementsAre;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// limit + c h^p at each h.
std::vector<double> sequence(const std::vector<double>& h, double limit, double c, double p) {
  std::vector<double> values;
  for (const double one : h) values.push_back(limit + c * std::pow(one, p));
  return values;
}

TEST(FittedOrder, IsThatOfAPower) {
  const std::vector<double> h{0.5, 0.25, 0.1, 0.03};
  for (const double p : {0.5, 1.0, 2.0}) EXPECT_NEAR(*fitted_order(h, sequence(h, 0.0, 7.0, p)).order, p, 1e-12);
}

TEST(FittedOrder, IsTheSlopeOfLeastSquares) {
  // log e = 0, -1, -4 at log h = 0, -1, -2: slope 2
  EXPECT_NEAR(*fitted_order({1.0, std::exp(-1.0), std::exp(-2.0)}, {1.0, std::exp(-1.0), std::exp(-4.0)}).order, 2.0, 1e-12);
}

TEST(FittedOrder, LeavesOutWhatIsNotThere) {
  EXPECT_NEAR(*fitted_order({1.0, 0.5, 0.25, none, 0.1}, {3.0, none, 0.75, 1.0, 0.3}).order, 1.0, 1e-12);
  EXPECT_EQ(fitted_order({1.0, 0.5}, {none, none}).reason, "no errors");
}

TEST(FittedOrder, IsNotFittedToRoundOff) {
  // The first two fall by the order 2; the others are what Newton's method leaves.
  const std::vector<double> h{1.0, 0.5, 0.25, 0.125, 0.0625};
  EXPECT_NEAR(*fitted_order(h, {4e-9, 1e-9, 3e-11, 0.0, 5e-11}).order, 2.0, 1e-12);
  for (const auto& errors : std::vector<std::vector<double>>{{1e-11, 1e-12, 1e-13}, {1.0, 1e-12, 0.0}, {1e-11, 1e-12, 9e-12}}) {
    const FittedOrder fitted = fitted_order({1.0, 0.5, 0.25}, errors);
    EXPECT_FALSE(fitted.order);
    EXPECT_EQ(fitted.reason, "fewer than two errors above round-off");
  }
}

TEST(FittedOrder, IsNoneOfErrorsThatDoNotFall) {
  for (const auto& errors : std::vector<std::vector<double>>{{1.0, 0.1, 0.2}, {1.0, 1.0, 0.1}, {0.1, 1e-12, 0.1}, {1e-12, 1e-3, 1e-4}}) {
    const FittedOrder fitted = fitted_order({1.0, 0.5, 0.25}, errors);
    EXPECT_FALSE(fitted.order);
    EXPECT_EQ(fitted.reason, "errors do not fall");
  }
  EXPECT_EQ(fitted_order({1.0, 1.0}, {2.0, 1.0}).reason, "mesh sizes do not fall");
}

TEST(Extrapolate, FindsLimitAndOrder) {
  const std::vector<double> h{0.5, 0.2, 0.1, 0.07};  // steps of different ratios
  for (const double p : {0.5, 1.0, 2.0, 3.7}) {
    const auto found = extrapolate(h, sequence(h, 5.0, -3.0, p), {});
    ASSERT_TRUE(found) << p;
    EXPECT_NEAR(found->order.value(), p, 1e-8);
    EXPECT_NEAR(found->limit, 5.0, 1e-8);
  }
}

TEST(Extrapolate, TakesAGivenOrder) {
  const std::vector<double> h{0.2, 0.1};
  EXPECT_NEAR(extrapolate(h, sequence(h, 5.0, 2.0, 2.0), 2.0)->limit, 5.0, 1e-12);
  EXPECT_FALSE(extrapolate(h, sequence(h, 5.0, 2.0, 2.0), {}));
}

TEST(Extrapolate, ValuesThatAgreeAreTheLimit) {
  const std::vector<double> h{4.0, 2.0, 1.0};
  const double e = std::numeric_limits<double>::epsilon();
  for (const auto& values : std::vector<std::vector<double>>{{7.0, 7.0, 7.0}, {0.0, 0.0, 0.0}, {-1.0, -1.0 - e, -1.0 - 3 * e}, {1.0, 1.0 + e, 1.0}}) {
    const auto found = extrapolate(h, values, {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->limit, values.back());
    EXPECT_FALSE(found->order);
    EXPECT_LE(found->uncertainty, 2 * e);
  }
  // Three values of a sequence that agree say more than an earlier one that does not.
  EXPECT_EQ(extrapolate({8.0, 4.0, 2.0, 1.0}, {9.0, 7.0, 7.0, 7.0}, {})->limit, 7.0);
  EXPECT_EQ(extrapolate({2.0, 1.0}, {7.0, 7.0}, 2.0)->limit, 7.0);
}

TEST(Extrapolate, ValuesThatOscillateOrRestLeaveTheFinestWithTheirSpread) {
  const std::vector<double> h{4.0, 2.0, 1.0};
  for (const auto& values :
       std::vector<std::vector<double>>{{1.0, 2.0, 1.5}, {2.0, 1.0, 1.5}, {1.0, 1.25, 0.75}, {1.0, 2.0, 2.0}, {1.0, 1.5, 1.5 + 1e-8}}) {
    const auto found = extrapolate(h, values, {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->limit, values[2]);
    EXPECT_FALSE(found->order);
    EXPECT_EQ(found->uncertainty, std::abs(values[2] - values[1]));
  }
}

TEST(Extrapolate, SaysNothingOfSequencesWithoutALimit) {
  EXPECT_FALSE(extrapolate({4.0, 2.0, 1.0}, {1.0, 2.0, 4.0}, {}));  // away
  EXPECT_FALSE(extrapolate({4.0, 2.0, 1.0}, {1.0, 2.0, 3.0}, {}));  // as a logarithm
  EXPECT_FALSE(extrapolate({4.0, 2.0, 1.0}, {1.0, 1.0, 2.0}, {}));
  EXPECT_FALSE(extrapolate({1.0, 2.0, 4.0}, {1.0, 1.5, 1.75}, {}));
  EXPECT_FALSE(extrapolate({4.0, 2.0, 1.0}, {1.0, none, 1.75}, {}));
}

TEST(WithinForGood, IsNoZeroCrossing) {
  EXPECT_THAT(within_for_good(0.1, {0.5, 0.001, 0.4, 0.05, 0.02}), ElementsAre(3, 4));
  EXPECT_THAT(within_for_good(0.1, {0.5, 0.001, 0.4}), ElementsAre());
  EXPECT_THAT(within_for_good(0.1, {0.5, 0.1, none, 0.02, none}), ElementsAre(1, 3));
  EXPECT_THAT(within_for_good(0.1, {}), ElementsAre());
}

TEST(TimeToError, IsLinearInTheLogarithms) {
  // error = 1 / t^2
  const auto time = time_to_error(0.01, {1.0, 4.0, 25.0}, {1.0, 1.0 / 16.0, 1.0 / 625.0});
  EXPECT_NEAR(time->seconds, 10.0, 1e-12);
  EXPECT_FALSE(time->at_most);
}

TEST(TimeToError, CountsFromWhereTheErrorStaysSmall) {
  EXPECT_NEAR(time_to_error(0.1, {1.0, 2.0, 4.0, 8.0}, {0.5, 0.001, 0.4, 0.025})->seconds, 4.0 * std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(time_to_error(0.1, {1.0, 2.0}, {0.01, 0.2}));
  EXPECT_FALSE(time_to_error(0.1, {1.0}, {none}));
  const auto first = time_to_error(0.1, {3.0, 9.0}, {0.1, 0.01});
  EXPECT_EQ(first->seconds, 3.0);
  EXPECT_TRUE(first->at_most);
  EXPECT_TRUE(first->confirmed);
  EXPECT_FALSE(time_to_error(0.1, {1.0, 2.0}, {0.5, 0.05})->confirmed);
}

TEST(CheapestRun, IsNoZeroCrossingAndPrefersWhatAFinerRunConfirms) {
  const std::vector<std::vector<std::size_t>> families{{0, 1, 2, 3}, {4, 5, 6}};
  const std::vector<double> seconds{1.0, 2.0, 4.0, 8.0, 0.5, 3.0, 5.0};
  // Runs 0 and 4 pass through nothing, run 6 has no finer one: 2 is the cheapest that another one, 3, confirms.
  const std::vector<double> errors{0.001, 0.3, 0.05, 0.02, 0.002, 0.2, 0.01};
  const auto cheapest = cheapest_run(0.1, seconds, errors, families);
  ASSERT_TRUE(cheapest);
  EXPECT_EQ(cheapest->run, 2u);
  EXPECT_TRUE(cheapest->confirmed);
  // Within less only the finest runs are, and 6 is faster than 3.
  const auto less = cheapest_run(0.03, seconds, errors, families);
  ASSERT_TRUE(less);
  EXPECT_EQ(less->run, 6u);
  EXPECT_FALSE(less->confirmed);
  EXPECT_FALSE(cheapest_run(0.005, seconds, errors, families));
  // A finer run that failed says nothing.
  EXPECT_FALSE(cheapest_run(0.1, {1.0, 2.0}, {0.05, none}, {{0, 1}})->confirmed);
}

TEST(ParetoFront, HoldsWhatNoOtherBeats) {
  EXPECT_THAT(pareto_front({1.0, 2.0, 3.0, 4.0, 0.5, 2.0}, {0.5, 0.2, 0.3, 0.1, none, 0.2}), ElementsAre(0, 1, 3));
  EXPECT_THAT(pareto_front({}, {}), ElementsAre());
}

TEST(Median, IsTheMiddle) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_EQ(median({7.0}), 7.0);
}

}  // namespace
}  // namespace mortise
