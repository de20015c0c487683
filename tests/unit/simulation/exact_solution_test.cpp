// Exact solutions against figures from the literature and against their own differential equations.

#include "mortise/simulation/quantities/exact_solution.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mortise/input/expression.hpp"

namespace mortise {
namespace {

HertzLineContact steel_on_aluminium() {
  HertzLineContact hertz;
  hertz.load = parse_expression("5000*t", {});
  hertz.radius = 50.0;
  hertz.first_youngs_modulus = 210000.0, hertz.first_poissons_ratio = 0.33;
  hertz.second_youngs_modulus = 71150.0, hertz.second_poissons_ratio = 0.30;
  return hertz;
}

TEST(HertzLineContact, HalfWidthAndPeakOfSteelOnAluminium) {
  const auto hertz = steel_on_aluminium();
  EXPECT_NEAR(hertz.half_width(1.0), 2.3285, 5e-5);  // figures with as many digits as published
  EXPECT_NEAR(hertz.peak(1.0), 1367.03, 5e-3);
  EXPECT_NEAR(hertz.half_width(0.25), 0.5 * hertz.half_width(1.0), 1e-14) << "a grows with the root of the load";
  EXPECT_EQ(hertz.pressure({0.0, 0.0}, 0.0), 0.0) << "no load, no pressure";
}

TEST(HertzLineContact, NafemsCylinderOnBlock) {
  HertzLineContact hertz;  // NAFEMS CB1: R 50, E 210000 on 70000, nu 0.3, 35 kN/mm: a = 6.2146, p = 3585.36
  hertz.load = ScalarFunction(35000.0);
  hertz.radius = 50.0;
  hertz.first_youngs_modulus = 210000.0, hertz.second_youngs_modulus = 70000.0;
  EXPECT_NEAR(hertz.half_width(1.0), 6.2146, 5e-5);
  EXPECT_NEAR(hertz.peak(1.0), 3585.36, 5e-3);
}

TEST(HertzLineContact, TwoCylindersOfGitterle) {
  HertzLineContact hertz;  // R 8 and 8, E 200, nu 0.3, p 0.625 on the diameter: b = 0.680778, p0 = 9.351351
  hertz.load = ScalarFunction(0.625 * 16.0);
  hertz.radius = 8.0, hertz.second_radius = 8.0;
  hertz.first_youngs_modulus = hertz.second_youngs_modulus = 200.0;
  EXPECT_NEAR(hertz.half_width(1.0), 0.680778, 5e-7);
  EXPECT_NEAR(hertz.peak(1.0), 9.351351, 5e-7);
}

TEST(HertzLineContact, PressureCarriesTheLoad) {
  auto hertz = steel_on_aluminium();
  hertz.center = 3.0;
  const double a = hertz.half_width(1.0);
  // x = center + a sin s removes the root at the ends: the integrand becomes p0 a cos^2 s, which the midpoint rule integrates exactly.
  double force = 0.0;
  const int points = 64;
  const double pi = std::acos(-1.0);
  for (int i = 0; i < points; ++i) {
    const double s = pi * ((i + 0.5) / points - 0.5);
    force += *hertz.pressure({3.0 + a * std::sin(s), 7.0}, 1.0) * a * std::cos(s) * pi / points;
  }
  EXPECT_NEAR(force, 5000.0, 5000.0 * 1e-12);
  EXPECT_EQ(hertz.pressure({3.0 + 1.0001 * a, 0.0}, 1.0), 0.0);
  EXPECT_EQ(hertz.zone(1.0)->center, 3.0);
  EXPECT_FALSE(hertz.stress({0.0, 0.0}, 1.0).has_value());
}

LameRing ring() {
  LameRing ring;
  ring.inner_radius = 1.0, ring.outer_radius = 3.0, ring.youngs_modulus = 200.0, ring.poissons_ratio = 0.3;
  ring.inner_pressure = ScalarFunction(5.0), ring.outer_pressure = ScalarFunction(2.0);
  ring.center_x = 0.4, ring.center_y = -0.7;
  return ring;
}

TEST(LameRing, MeetsItsPressures) {
  const auto lame = ring();
  const double r2 = std::sqrt(0.5);
  const Eigen::Vector3d n(r2, r2, 0.0);
  const Eigen::Vector3d inner = *lame.stress({0.4 + r2, -0.7 + r2}, 1.0) * n, outer = *lame.stress({0.4 + 3.0 * r2, -0.7 + 3.0 * r2}, 1.0) * n;
  EXPECT_LT((inner + 5.0 * n).norm(), 1e-13);
  EXPECT_LT((outer + 2.0 * n).norm(), 1e-13);
  EXPECT_NEAR(*lame.pressure({1.4, -0.7}, 1.0), 5.0, 1e-13);
  EXPECT_NEAR(*lame.pressure({0.4, 2.3}, 1.0), 2.0, 1e-13);
}

// div sigma = 0 and sigma = C : sym grad u, by central differences. Their truncation is (h/r)^2 times the field's size, their round-off eps/h.
TEST(LameRing, IsInEquilibriumAndElastic) {
  const auto lame = ring();
  const double h = 1e-4, mu = 200.0 / 2.6, lambda = 200.0 * 0.3 / (1.3 * 0.4);
  for (const ExactSolution::Point& x : {ExactSolution::Point{1.9, 0.3}, {-0.8, -0.1}, {0.5, -2.5}}) {
    const auto at = [&](int i, double step) { return ExactSolution::Point{x[0] + (i == 0 ? step : 0.0), x[1] + (i == 1 ? step : 0.0)}; };
    Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
    Eigen::Vector3d divergence = Eigen::Vector3d::Zero();
    for (int j = 0; j < 2; ++j) {
      const auto plus = *lame.displacement(at(j, h), 1.0), minus = *lame.displacement(at(j, -h), 1.0);
      for (int i = 0; i < 2; ++i) gradient(i, j) = (plus[i] - minus[i]) / (2.0 * h);
      divergence += (lame.stress(at(j, h), 1.0)->col(j) - lame.stress(at(j, -h), 1.0)->col(j)) / (2.0 * h);
    }
    const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
    const Eigen::Matrix3d stress = lambda * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * mu * strain;
    EXPECT_LT((stress - *lame.stress(x, 1.0)).norm(), 1e-6);
    EXPECT_LT(divergence.norm(), 1e-6);
  }
}

TEST(ExactSolutions, UniformAndLinear) {
  UniformState uniform;
  uniform.contact_pressure = parse_expression("3*t", {}), uniform.xx = ScalarFunction(1.0), uniform.xy = ScalarFunction(-2.0);
  EXPECT_EQ(uniform.pressure({9.0, 9.0}, 2.0), 6.0);
  EXPECT_EQ((*uniform.stress({0.0, 0.0}, 1.0))(1, 0), -2.0);
  EXPECT_EQ((*uniform.stress({0.0, 0.0}, 1.0))(0, 0), 1.0);
  LinearDisplacement linear;
  linear.x = ScalarFunction(1.0), linear.xy = parse_expression("0.5*t", {}), linear.yx = ScalarFunction(-2.0);
  EXPECT_EQ((*linear.displacement({3.0, 4.0}, 2.0))[0], 5.0);
  EXPECT_EQ((*linear.displacement({3.0, 4.0}, 2.0))[1], -6.0);
}

}  // namespace
}  // namespace mortise
