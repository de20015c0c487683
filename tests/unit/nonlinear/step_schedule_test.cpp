#include "mortise/nonlinear/step_schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mortise {
namespace {

using ::testing::ElementsAre;

// Times of accepted steps; tries numbered in `failing` (from 0) fail, all others are easy if `easy`.
std::vector<double> times(const SteppingOptions& options, bool easy, const std::vector<int>& failing = {}) {
  StepSchedule schedule(options);
  std::vector<double> result;
  for (int attempt = 0; !schedule.finished() && attempt < 1000; ++attempt) {
    if (std::find(failing.begin(), failing.end(), attempt) != failing.end()) {
      if (!schedule.cut()) break;
      continue;
    }
    result.push_back(schedule.next_time());
    schedule.accept(easy ? 2.0 : 1.0);
    EXPECT_EQ(schedule.time(), result.back());
  }
  return result;
}

TEST(StepSchedule, HitsOutputTimesAndEndExactly) {
  SteppingOptions options;
  options.end_time = 1.0;
  options.step = 0.3;
  options.output_times = {0.7, 0.3, 1.0};
  EXPECT_THAT(times(options, true), ElementsAre(0.3, 0.6, 0.7, 1.0));
}

// Ten times 0.1 is not 1 in binary numbers; there is no eleventh step all the same.
TEST(StepSchedule, LeavesNoSliverOfRoundOff) {
  SteppingOptions options;
  options.step = 0.1;
  const auto result = times(options, false);
  ASSERT_EQ(result.size(), 10u);
  EXPECT_EQ(result.back(), 1.0);
}

TEST(StepSchedule, HalvesAndGrowsAgain) {
  SteppingOptions options;
  options.step = 0.5;
  EXPECT_THAT(times(options, true, {0, 1}), ElementsAre(0.125, 0.375, 0.875, 1.0));
  EXPECT_THAT(times(options, false, {0, 1}), ElementsAre(0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0));
}

TEST(StepSchedule, GrowsUpToTheLargestStep) {
  SteppingOptions options;
  options.step = 0.0625;
  options.maximum_step = 0.25;
  EXPECT_THAT(times(options, true), ElementsAre(0.0625, 0.1875, 0.4375, 0.6875, 0.9375, 1.0));
}

TEST(StepSchedule, AStepCutShortByATargetDoesNotGrow) {
  SteppingOptions options;
  options.step = 0.25;
  options.maximum_step = 1.0;
  options.output_times = {0.0625};
  EXPECT_THAT(times(options, true), ElementsAre(0.0625, 0.3125, 0.8125, 1.0));
}

TEST(StepSchedule, StopsAtTheSmallestStep) {
  SteppingOptions options;
  options.minimum_step = 0.25;
  StepSchedule schedule(options);
  EXPECT_TRUE(schedule.cut());
  EXPECT_TRUE(schedule.cut());
  EXPECT_EQ(schedule.next_time(), 0.25);
  EXPECT_FALSE(schedule.cut());
}

TEST(StepSchedule, DefaultOfTheSmallestStepAllowsTenHalvings) {
  StepSchedule schedule(SteppingOptions{});
  int cuts = 0;
  while (cuts < 100 && schedule.cut()) ++cuts;
  EXPECT_EQ(cuts, 10);
}

}  // namespace
}  // namespace mortise
