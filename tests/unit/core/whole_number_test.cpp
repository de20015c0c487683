#include "mortise/core/whole_number.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace mortise {
namespace {

TEST(WholeNumber, IsWhatTheTypeCanHold) {
  EXPECT_EQ(whole_number<int>(-3.0), -3);
  EXPECT_EQ(whole_number<int>(-0.0), 0);
  EXPECT_EQ(whole_number<int>(2147483647.0), 2147483647);
  EXPECT_EQ(whole_number<int>(-2147483648.0), std::numeric_limits<int>::min());
  EXPECT_EQ(whole_number<unsigned char>(255.0), 255);
  EXPECT_EQ(whole_number<bool>(1.0), true);
  EXPECT_EQ(whole_number<std::uint64_t>(std::ldexp(1.0, 63)), std::uint64_t{1} << 63);
}

TEST(WholeNumber, IsNothingElse) {
  EXPECT_FALSE(whole_number<int>(0.5));
  EXPECT_FALSE(whole_number<int>(2147483648.0));
  EXPECT_FALSE(whole_number<int>(-2147483649.0));
  EXPECT_FALSE(whole_number<unsigned char>(256.0));
  EXPECT_FALSE(whole_number<unsigned char>(-1.0));
  EXPECT_FALSE(whole_number<bool>(2.0));
  EXPECT_FALSE(whole_number<std::int64_t>(std::ldexp(1.0, 63)));
  EXPECT_FALSE(whole_number<std::uint64_t>(std::ldexp(1.0, 64)));
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300})
    EXPECT_FALSE(whole_number<std::int64_t>(value)) << value;
}

}  // namespace
}  // namespace mortise
