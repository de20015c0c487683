// Functions of the temperature and their derivatives.

#include "mortise/core/temperature_function.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mortise/core/guarded_value.hpp"

namespace mortise {
namespace {

TEST(TemperatureFunction, OfATableHasTheSlopeOfItsLines) {
  const TemperatureFunction table({10.0, 20.0, 40.0}, {1.0, 3.0, 2.0});
  const auto expect = [&](double theta, double value, double slope) {
    EXPECT_DOUBLE_EQ(table.at(theta), value) << theta;
    EXPECT_DOUBLE_EQ(table.with_slope(theta).value, value) << theta;
    EXPECT_DOUBLE_EQ(table.with_slope(theta).slope, slope) << theta;
  };
  expect(-5.0, 1.0, 0.0);
  expect(15.0, 2.0, 0.2);
  expect(20.0, 3.0, -0.05);  // at a kink that of the right line
  expect(30.0, 2.5, -0.05);
  expect(50.0, 2.0, 0.0);
  EXPECT_TRUE(std::isnan(table.at(std::nan(""))));
  EXPECT_TRUE(table.is_given());
  EXPECT_FALSE(table.is_constant());
}

TEST(TemperatureFunction, OfNumbersIsConstant) {
  const TemperatureFunction number(4.0);
  EXPECT_DOUBLE_EQ(number.at(1e6), 4.0);
  EXPECT_EQ(number.with_slope(3.0).slope, 0.0);
  EXPECT_TRUE(number.is_constant());
  EXPECT_FALSE(TemperatureFunction().is_given());
}

// Central differences: eps^(2/3), relative to the scale over which the function varies.
TEST(TemperatureFunction, OfExpressionsHasADifferenceAsSlope) {
  const ScalarFunction f([](const std::vector<double>& at) { return std::exp(0.01 * at[0]); }, "exp(0.01 temperature)");
  for (const double theta : {-20.0, 0.0, 1e-9, 3.0, 293.15, 1200.0}) {
    const ValueAndSlope result = TemperatureFunction(f).with_slope(theta);
    EXPECT_DOUBLE_EQ(result.value, std::exp(0.01 * theta));
    EXPECT_NEAR(result.slope, 0.01 * std::exp(0.01 * theta), 1e-8 * 0.01 * std::exp(0.01 * theta)) << theta;
  }
}

TEST(TemperatureFunction, HasNoValueWhereAnExpressionThrows) {
  const ScalarFunction f([](const std::vector<double>&) -> double { throw std::runtime_error("no"); }, "f");
  EXPECT_TRUE(std::isnan(TemperatureFunction(f).at(1.0)));
  EXPECT_TRUE(std::isnan(TemperatureFunction(f).with_slope(1.0).slope));
}

TEST(TemperatureFunction, SaysWhatIsWrongWithATable) {
  EXPECT_FALSE(TemperatureFunction(1.0).fault());
  EXPECT_FALSE(TemperatureFunction().fault());
  EXPECT_FALSE(TemperatureFunction({0.0, 1.0}, {3.0, -2.0}).fault());
  EXPECT_EQ(*TemperatureFunction({0.0, 1.0}, {3.0}).fault(), "\"temperatures\" of a table has 2 numbers and \"values\" 1; give as many of both");
  EXPECT_EQ(*TemperatureFunction({1.0, 1.0}, {3.0, 4.0}).fault(),
            "\"temperatures\" of a table has 1 at place 2; numbers have to be finite and ascend");
  EXPECT_EQ(*TemperatureFunction({0.0, 1.0}, {3.0, std::nan("")}).fault(), "\"values\" of a table has nan at place 2; numbers have to be finite");
  TemperatureFunction both(2.0);
  both.table = {{0.0}, {1.0}};
  EXPECT_EQ(*both.fault(), "an expression and a table are given; give one of them");
}

// The derivative by one of several arguments.
TEST(TemperatureFunction, PartialDerivativesKeepTheOtherArguments) {
  const ScalarFunction f([](const std::vector<double>& at) { return at[0] * at[1] + at[2]; }, "f");
  const ValueAndSlope result = value_and_slope(f, {2.0, 5.0, 1.0}, 1);
  EXPECT_DOUBLE_EQ(result.value, 11.0);
  EXPECT_NEAR(result.slope, 2.0, 1e-9);
}

}  // namespace
}  // namespace mortise
