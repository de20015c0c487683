#include "mortise/core/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mortise {
namespace {

TEST(Table, IsStraightBetweenItsTimesAndConstantBeyond) {
  const Table table{{0.0, 1.0, 3.0}, {2.0, 4.0, 0.0}};
  EXPECT_EQ(table(-1.0), 2.0);
  EXPECT_EQ(table(0.5), 3.0);
  EXPECT_EQ(table(2.0), 2.0);
  EXPECT_EQ(table(7.0), 0.0);
  EXPECT_EQ(table(std::numeric_limits<double>::infinity()), 0.0);
}

TEST(Table, HasNoValueWhereTimeIsNoNumber) {
  const Table table{{0.0, 1.0}, {2.0, 4.0}};
  EXPECT_TRUE(std::isnan(table(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace mortise
