#include "mortise/nonlinear/cycle_detector.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace mortise {
namespace {

using Sequence = std::vector<std::pair<long long, double>>;  // active set, increment

int cycle_of(const Sequence& sequence, int longest = 6) {
  CycleDetector detector(longest);
  int found = 0;
  for (const auto& [set, increment] : sequence) {
    EXPECT_EQ(found, 0) << "found too early";
    detector.add({set, -set}, increment);
    found = detector.cycle();
  }
  return found;
}

TEST(CycleDetector, FindsACycleOnceItHasRunTwice) {
  EXPECT_EQ(cycle_of({{5, 0.0}, {1, 1.0}, {2, 1.0}, {1, 1.0}, {2, 1.0}}), 2);
  EXPECT_EQ(cycle_of({{1, 1.0}, {2, 1.0}, {3, 1.0}, {1, 1.0}, {2, 1.0}, {3, 1.0}}), 3);
}

TEST(CycleDetector, ASettledSetIsNoCycle) { EXPECT_EQ(cycle_of({{1, 1.0}, {2, 1.0}, {2, 1.0}, {2, 1.0}, {2, 1.0}, {2, 1.0}}), 0); }

TEST(CycleDetector, SetsThatReturnWhileCorrectionsShrinkAreNoCycle) {
  EXPECT_EQ(cycle_of({{1, 1.0}, {2, 1.0}, {1, 0.3}, {2, 0.3}, {1, 0.1}, {2, 0.1}}), 0);
}

TEST(CycleDetector, LooksNoFurtherThanItIsTold) {
  const Sequence three = {{1, 1.0}, {2, 1.0}, {3, 1.0}, {1, 1.0}, {2, 1.0}, {3, 1.0}};
  EXPECT_EQ(cycle_of(three, 2), 0);
  EXPECT_EQ(cycle_of({{1, 1.0}, {2, 1.0}, {1, 1.0}, {2, 1.0}}, 0), 0);
}

TEST(CycleDetector, BothHashesCount) {
  CycleDetector detector(6);
  for (const std::array<long long, 2> set : {std::array<long long, 2>{1, 1}, {1, 2}, {1, 3}, {1, 4}}) detector.add(set, 1.0);
  EXPECT_EQ(detector.cycle(), 0);
}

}  // namespace
}  // namespace mortise
