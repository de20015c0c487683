// Laws of conductance: values, slopes, what is refused.
#include "mortise/thermal_contact/conductance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "mortise/thermal_contact/gap_conductance.hpp"
#include "mortise/thermal_contact/thermal_contact.hpp"

namespace mortise {
namespace {

PowerConductance rough() {
  PowerConductance law;
  law.factor = 8.0;
  law.hardness = 20.0;
  law.without_pressure = 0.5;
  return law;
}

TabulatedConductance table() {
  TabulatedConductance law;
  law.pressures = {0.0, 1.0, 3.0};
  law.conductances = {1.0, 4.0, 5.0};
  return law;
}

void expect_slopes_of_differences(const ConductanceLaw& law, const TouchingPoint& at) {
  const double step = 1e-6;
  const auto difference = [&](double TouchingPoint::*of) {
    TouchingPoint up = at, down = at;
    up.*of += step * at.*of;
    down.*of -= step * at.*of;
    return (law.at(up).value - law.at(down).value) / (2.0 * step * at.*of);
  };
  const Conductance h = law.at(at);
  EXPECT_NEAR(h.of_pressure, difference(&TouchingPoint::pressure), 1e-7 * h.value / at.pressure);
  EXPECT_NEAR(h.of_temperature, difference(&TouchingPoint::temperature), 1e-7 * h.value / at.temperature);
  EXPECT_NEAR(h.of_slip_rate, difference(&TouchingPoint::slip_rate), 1e-7 * h.value / at.slip_rate);
}

TEST(Conductance, HasTheSlopesOfDifferences) {
  ConductanceFunction function;
  function.conductance = ScalarFunction([](const std::vector<double>& of) { return of[0] * of[1] + std::sqrt(of[2]); }, "h");
  const PowerConductance power = rough();
  const TabulatedConductance lines = table();
  for (const double p : {1e-7, 0.4, 2.0, 7.0}) {
    expect_slopes_of_differences(function, {p, 300.0, 0.2, 1.0});
    expect_slopes_of_differences(power, {p, 300.0, 0.2, 1.0});
    expect_slopes_of_differences(lines, {p, 300.0, 0.2, 1.0});
  }
}

TEST(ConductanceFunction, HasItsSlopesAtZero) {
  ConductanceFunction function;
  function.conductance = ScalarFunction([](const std::vector<double>& of) { return 3.0 * of[0] + 2.0 * of[1] + 5.0 * of[2]; }, "h");
  const Conductance h = function.at({0.0, 0.0, 0.0, 0.0});
  EXPECT_NEAR(h.of_pressure, 3.0, 1e-9);
  EXPECT_NEAR(h.of_temperature, 2.0, 1e-9);
  EXPECT_NEAR(h.of_slip_rate, 5.0, 1e-9);
}

// (p / H)^m has no bounded slope at 0: the secant from a millionth of the largest pressure on does, and joins.
TEST(PowerConductance, IsASecantBelowAMillionthOfTheLargestPressure) {
  const PowerConductance law = rough();
  const double least = 1e-6 * 5.0, there = 8.0 * std::pow(least / 20.0, 0.95);
  EXPECT_DOUBLE_EQ(law.at({least, 300.0, 0.0, 5.0}).value, 0.5 + there);
  EXPECT_NEAR(law.at({least * (1.0 - 1e-12), 300.0, 0.0, 5.0}).value, 0.5 + there, 1e-10 * there);
  EXPECT_NEAR(law.at({0.5 * least, 300.0, 0.0, 5.0}).value, 0.5 + 0.5 * there, 1e-12 * there);
  EXPECT_EQ(law.at({0.0, 300.0, 0.0, 5.0}).value, 0.5);
  EXPECT_NEAR(law.at({0.0, 300.0, 0.0, 5.0}).of_pressure, there / least, 1e-12 * there / least);
  const double of_hardness = 1e-6 * 20.0;  // where nothing presses anywhere, as where the first node closes
  EXPECT_NEAR(law.at({0.0, 300.0, 0.0, 0.0}).of_pressure, 8.0 * std::pow(1e-6, 0.95) / of_hardness,
              1e-12 * law.at({0.0, 300.0, 0.0, 0.0}).of_pressure);
  EXPECT_NEAR(law.at({2.0, 300.0, 0.0, 5.0}).value, 0.5 + 8.0 * std::pow(0.1, 0.95), 1e-14);
}

TEST(TabulatedConductance, IsConstantBeyondItsPoints) {
  const TabulatedConductance law = table();
  EXPECT_EQ(law.at({2.0, 0.0, 0.0, 0.0}).value, 4.5);
  EXPECT_EQ(law.at({9.0, 0.0, 0.0, 0.0}).value, 5.0);
  EXPECT_EQ(law.at({9.0, 0.0, 0.0, 0.0}).of_pressure, 0.0);
}

TEST(GapConductance, HasTheSlopesOfDifferences) {
  MediumConductance medium;
  medium.conductivity = 0.3;
  medium.distance = 0.02;
  TabulatedGapConductance lines;
  lines.gaps = {0.0, 0.1, 0.4};
  lines.conductances = {9.0, 2.0, 0.0};
  for (const GapConductance* law : std::initializer_list<const GapConductance*>{&medium, &lines})
    for (const double g : {0.03, 0.2, 0.5}) {
      const double step = 1e-6 * g;
      EXPECT_NEAR(law->at(g).of_gap, (law->at(g + step).value - law->at(g - step).value) / (2.0 * step), 1e-7 * (1.0 + law->at(g).value / g));
    }
  EXPECT_DOUBLE_EQ(medium.at(0.0).value, 15.0);
}

TEST(LawsOfConductance, RefuseWhatMakesNoLaw) {
  ConstantConductance constant;
  EXPECT_FALSE(constant.fault());
  constant.value = -1.0;
  EXPECT_TRUE(constant.fault());
  constant.value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(constant.fault());
  PowerConductance power = rough();
  EXPECT_FALSE(power.fault());
  power.hardness = 0.0;
  EXPECT_TRUE(power.fault());
  power = rough();
  power.exponent = 0.0;
  EXPECT_TRUE(power.fault());
  power = rough();
  power.factor = -1.0;
  EXPECT_TRUE(power.fault());
  TabulatedConductance lines = table();
  EXPECT_FALSE(lines.fault());
  lines.pressures = {0.0, 1.0, 1.0};
  EXPECT_TRUE(lines.fault());
  lines = table();
  lines.conductances = {1.0, -1e-3, 2.0};
  EXPECT_TRUE(lines.fault());
  lines.conductances = {1.0};
  EXPECT_TRUE(lines.fault());
  EXPECT_TRUE(TabulatedConductance().fault());
  EXPECT_TRUE(MediumConductance().fault());
  EXPECT_TRUE(TabulatedGapConductance().fault());
}

// Half spaces of 1 and 3 that come to touch: the first takes a quarter.
TEST(ShareOfSlave, FollowsFromEffusivities) {
  EXPECT_DOUBLE_EQ(share_of_slave(1.0, 3.0), 0.25);
  EXPECT_DOUBLE_EQ(share_of_slave(0.0, 3.0), 0.0);
  EXPECT_THROW(share_of_slave(0.0, 0.0), std::invalid_argument);
  EXPECT_THROW(share_of_slave(-1.0, 3.0), std::invalid_argument);
  EXPECT_THROW(share_of_slave(1.0, std::numeric_limits<double>::infinity()), std::invalid_argument);
}

}  // namespace
}  // namespace mortise
