// Curves of pressure and overclosure: values, where lines meet them, what is refused.

#include "mortise/contact/pressure_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mortise {
namespace {

constexpr double round_off = 1e-13;

std::shared_ptr<LinearPressure> linear(double stiffness) {
  const auto law = std::make_shared<LinearPressure>();
  law->stiffness = stiffness;
  return law;
}

std::shared_ptr<ExponentialPressure> exponential(double clearance, double pressure, ExponentialPressure::Curve curve) {
  const auto law = std::make_shared<ExponentialPressure>();
  law->clearance = clearance;
  law->pressure = pressure;
  law->curve = curve;
  return law;
}

std::shared_ptr<TabulatedPressure> table(std::vector<double> overclosures, std::vector<double> pressures) {
  const auto law = std::make_shared<TabulatedPressure>();
  law->overclosures = std::move(overclosures);
  law->pressures = std::move(pressures);
  return law;
}

/// A law and the same curve written down once more.
struct Curve {
  std::string name;
  std::shared_ptr<PressureLaw> law;
  std::function<double(double)> pressure;
  double length;  ///< in which it changes
};

std::vector<Curve> curves() {
  const double c0 = 0.02, p0 = 7.0, e = std::exp(1.0), beta = std::log(100.0) / c0;
  return {
      {"linear", linear(350.0), [](double h) { return h > 0.0 ? 350.0 * h : 0.0; }, c0},
      {"from zero", exponential(c0, p0, ExponentialPressure::Curve::from_zero),
       [=](double h) {
         const double s = h / c0 + 1.0;
         return s > 0.0 ? p0 / (e - 1.0) * s * (std::exp(s) - 1.0) : 0.0;
       },
       c0},
      {"from a hundredth", exponential(c0, p0, ExponentialPressure::Curve::from_hundredth),
       [=](double h) { return h > -c0 ? p0 * std::exp(beta * h) : std::max(0.0, p0 / 100.0 * (1.0 + beta * (h + c0))); }, c0},
      {"table", table({-0.02, 0.0, 0.01, 0.03, 0.04}, {0.0, 0.0, 5.0, 5.0, 25.0}),
       [](double h) { return h < 0.0    ? 0.0
                             : h < 0.01 ? 500.0 * h
                             : h < 0.03 ? 5.0
                                        : 5.0 + 2000.0 * (h - 0.03); }, c0},
  };
}

// A point of the curve, put on a line of any slope, is found again. The two equations of its place, divided by p' + c, have errors of round-off of
// their terms.
TEST(PressureLaw, LinesMeetTheCurveWhereItsPointsAre) {
  for (const Curve& curve : curves())
    for (const double relative : {1e-4, 1.0, 1e4})
      for (int i = -40; i <= 200; ++i) {
        const double h = 0.0501 * i * curve.length, p = curve.pressure(h), c = relative * 350.0;
        const PressurePoint point = curve.law->on_line(p + c * h, c);
        SCOPED_TRACE(curve.name + ", h = " + std::to_string(h) + ", c = " + std::to_string(c));
        const double size = p + c * std::abs(h);
        EXPECT_NEAR(point.overclosure, h, round_off * (curve.length + std::abs(h) + size / (point.slope + c)));
        EXPECT_NEAR(point.pressure, p, round_off * (p + point.slope * (curve.length + std::abs(h) + size / (point.slope + c))));
        EXPECT_EQ(point.pressure > 0.0, p > 0.0);
        EXPECT_EQ(h > curve.law->onset(), p > 0.0);
      }
}

// Between kinks.
TEST(PressureLaw, SlopesAreThoseOfDifferences) {
  for (const Curve& curve : curves())
    for (int i = -40; i <= 60; ++i) {
      const double h = (0.0501 * i + 0.003) * curve.length, step = 1e-6 * curve.length, p = curve.pressure(h);
      const double difference = (curve.pressure(h + step) - curve.pressure(h - step)) / (2.0 * step);
      SCOPED_TRACE(curve.name + ", h = " + std::to_string(h));
      // The error of central differences: (step / length)^2 and the growth of the third derivative (5^3), round-off over the step.
      EXPECT_NEAR(curve.law->on_line(p + 350.0 * h, 350.0).slope, difference, 1e-9 * (std::abs(difference) + p / curve.length));
    }
}

// Trial values of an iteration: far beyond where the exponential itself overflows.
TEST(PressureLaw, NoLineOverflows) {
  for (const Curve& curve : curves())
    for (const double sum : {1e-300, 1e-20, 1.0, 1e10, 1e100, 1e300})
      for (const double c : {1e-8, 1.0, 1e12}) {
        SCOPED_TRACE(curve.name);
        const PressurePoint point = curve.law->on_line(sum, c);
        EXPECT_TRUE(std::isfinite(point.overclosure) && std::isfinite(point.pressure) && std::isfinite(point.slope));
        // On the line: as well as p is known where h is rounded.
        const double unit = std::numeric_limits<double>::epsilon();
        EXPECT_NEAR(point.pressure + c * point.overclosure, sum,
                    16.0 * unit * (sum + (point.slope + c) * (std::abs(point.overclosure) + curve.length)));
      }
}

TEST(PressureLaw, ExponentialsPassThroughTheirPressureWhereSurfacesTouch) {
  for (const auto curve : {ExponentialPressure::Curve::from_zero, ExponentialPressure::Curve::from_hundredth})
    EXPECT_NEAR(exponential(0.3, 2.0, curve)->on_line(2.0, 5.0).pressure, 2.0, round_off);
  const double e = std::exp(1.0);
  EXPECT_NEAR(exponential(0.3, 2.0, ExponentialPressure::Curve::from_zero)->typical_slope(), 2.0 / 0.3 * (1.0 + e / (e - 1.0)), 1e-12);
  EXPECT_NEAR(exponential(0.3, 2.0, ExponentialPressure::Curve::from_hundredth)->typical_slope(), 2.0 / 0.3 * std::log(100.0), 1e-12);
}

TEST(PressureLaw, NumbersThatMakeNoCurveAreFaults) {
  const auto says = [](const PressureLaw& law, const std::string& text) {
    const auto fault = law.fault();
    return fault && fault->find(text) != std::string::npos;
  };
  for (const Curve& curve : curves()) EXPECT_FALSE(curve.law->fault()) << curve.name;
  EXPECT_TRUE(says(*linear(0.0), "stiffness of a linear pressure is 0"));
  EXPECT_TRUE(says(*exponential(0.0, 1.0, ExponentialPressure::Curve::from_zero), "give both above 0"));
  EXPECT_TRUE(says(*table({0.0}, {0.0}), "2 or more"));
  EXPECT_TRUE(says(*table({0.0, 1.0}, {0.0, 1.0, 2.0}), "has 2 values and \"pressures\" 3"));
  EXPECT_TRUE(says(*table({0.0, 0.5, 0.5}, {0.0, 1.0, 2.0}), "has 0.5 after 0.5"));
  EXPECT_TRUE(says(*table({0.0, 1.0, 2.0}, {0.0, 2.0, 1.0}), "has 1 after 2"));
  EXPECT_TRUE(says(*table({0.0, 1.0}, {0.5, 1.0}), "begins with 0.5"));
  EXPECT_TRUE(says(*table({0.0, 1.0}, {0.0, 0.0}), "nothing would act"));
}

}  // namespace
}  // namespace mortise
