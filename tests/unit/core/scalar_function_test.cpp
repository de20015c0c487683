#include "mortise/core/scalar_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mortise {
namespace {

TEST(ScalarFunction, IsAConstantOrWhatCodeComputes) {
  const ScalarFunction constant(0.3);
  EXPECT_TRUE(constant.is_constant());
  EXPECT_EQ(constant.source(), "0.3");
  EXPECT_EQ(constant.at({}), 0.3);
  EXPECT_EQ(constant(1.0, 2.0), 0.3);

  const ScalarFunction computed([](const std::vector<double>& of) { return of[0] * of[2]; }, "t*y", {"block.in", 4, "loads"});
  const ScalarFunction copy = computed;
  EXPECT_FALSE(copy.is_constant());
  EXPECT_EQ(copy(3.0, 7.0, 2.0), 6.0);
  EXPECT_EQ(copy.at({2.0, 0.0, 5.0, 9.0}), 10.0);
  EXPECT_EQ(copy.source(), "t*y");
  EXPECT_EQ(copy.place().line, 4);
}

TEST(ScalarFunction, SaysWhereItHasNoValue) {
  const ScalarFunction root([](const std::vector<double>& of) { return std::sqrt(of[0] - 1.0); }, "sqrt(t - 1)", {"block.in", 4, "loads"});
  EXPECT_TRUE(std::isnan(root.at({0.0})));
  try {
    root(0.5, 1.0);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "block.in:4: error: loads: \"sqrt(t - 1)\" is nan at t = 0.5, x = 1, y = 0, z = 0");
  }
}

}  // namespace
}  // namespace mortise
