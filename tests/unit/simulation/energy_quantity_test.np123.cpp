// Energies and works of fields made by hand; the same on any number of ranks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "quantity_fixture.hpp"

namespace mortise {
namespace {

using namespace test;

TEST(Energy, StoredIsHalfStressTimesStrain) {
  TwoBlocks blocks;
  blocks.move([](int body, const Point& X) { return body == 0 ? uniform_strain(X) : Point{0.3, 0.3}; });
  const double expected = 0.5 * (stress_xx * 0.01 + stress_yy * -0.02 + stress_xy * 0.006) * width * thickness;
  EXPECT_NEAR(blocks.value(*quantity("energy")), expected, 1e-13);
  EXPECT_NEAR(blocks.value(*quantity("energy", {{"body", "upper"}})), 0.0, 1e-13);
}

// The upper block glides by 0.5 under a shear traction of 1.5, then by 0.3 under twice as much; the trapezoidal rule starts from nothing.
TEST(Energy, FrictionIsTheWorkOfShearTractions) {
  for (const bool rubs : {true, false}) {
    TwoBlocks blocks(Kinematics::plane_strain, ContactGeometry::current, rubs);
    const auto friction = quantity("energy", {{"of", "friction"}})->make_evaluator(blocks.context());
    const auto glide = [&](double x) { blocks.move([x](int body, const Point&) { return Point{body == 0 ? 0.0 : x, 0.0}; }); };
    // Forward the front node leaves the lower block: what is covered is 0.5 and 0.8 shorter.
    blocks.press([](double) { return 10.0; }, 1.5);
    glide(0.5);
    double work = 0.5 * 1.5 * (width - 0.5) * thickness * 0.5;
    EXPECT_NEAR(friction->evaluate(blocks.context()), rubs ? work : 0.0, 1e-12);
    const double before = 1.5 * (width - 0.5) * thickness;
    blocks.press([](double) { return 10.0; }, 3.0);
    glide(0.8);
    work += 0.5 * (before + 3.0 * (width - 0.8) * thickness) * 0.3;
    EXPECT_NEAR(friction->evaluate(blocks.context()), rubs ? work : 0.0, 1e-12);
  }
}

// Both blocks move down by 0.1 with the same forces at either end of the step; f_int = r + f_ext - f_c, and f_c does no work.
TEST(Energy, WhatIsLeftOfExternalWorkIsAnError) {
  TwoBlocks blocks;
  blocks.press([](double) { return 3.0; });
  const auto sink = [&](double y) { blocks.move([y](int, const Point&) { return Point{0.0, -y}; }); };
  blocks.external = blocks.nodal([](int, const Point& X) { return Point{0.0, X[1] == 2.0 ? -5.0 : 0.0}; });  // 6 nodes
  blocks.reaction = blocks.nodal([](int, const Point&) { return Point{0.0, 0.0}; });
  const auto internal = quantity("energy", {{"of", "internal work"}})->make_evaluator(blocks.context());
  const auto error = quantity("energy error")->make_evaluator(blocks.context());
  const auto of_stored = quantity("energy error", {{"against", "stored and plastic"}})->make_evaluator(blocks.context());
  EXPECT_TRUE(std::isnan(error->evaluate(blocks.context()))) << "nothing has been done";
  internal->evaluate(blocks.context());
  of_stored->evaluate(blocks.context());
  sink(0.1);
  EXPECT_NEAR(internal->evaluate(blocks.context()), 30.0 * 0.1, 1e-13);
  EXPECT_NEAR(error->evaluate(blocks.context()), 0.0, 1e-13);
  EXPECT_NEAR(of_stored->evaluate(blocks.context()), 1.0, 1e-13) << "a rigid motion stores nothing";

  // Only the upper block moves: pressures of 3 do 3 * width * thickness * 0.125 on it.
  blocks.move([](int body, const Point&) { return Point{0.0, body == 0 ? -0.1 : 0.025}; });
  const double external = 3.0 - 30.0 * 0.125, of_pressure = 3.0 * width * thickness * 0.125;
  EXPECT_NEAR(error->evaluate(blocks.context()), -of_pressure / std::max(std::abs(external), std::abs(external + of_pressure)), 1e-12);
}

// A load F on one corner that grows with its displacement, F = d: W = d^2/2; and a support that moves on under a constant force.
TEST(Energy, WorkFromOutsideAddsUpOverSteps) {
  TwoBlocks blocks;
  blocks.prescribed = blocks.dofs("lower/bottom");
  const auto work = quantity("energy", {{"of", "external work"}})->make_evaluator(blocks.context());
  const auto corner = [](int, const Point& X, double value) { return Point{X[0] == width && X[1] == 2.0 ? value : 0.0, 0.0}; };
  for (const double d : {0.25, 1.0}) {
    blocks.external = blocks.nodal([&](int body, const Point& X) { return corner(body, X, d); });
    blocks.move([&](int body, const Point& X) { return corner(body, X, d); });
    EXPECT_NEAR(work->evaluate(blocks.context()), 0.5 * d * d, 1e-15);
    EXPECT_NEAR(work->evaluate(blocks.context()), 0.5 * d * d, 1e-15) << "asked twice";
  }
  // The supports push with 2 at each of 5 nodes; only their last motion, by 0.1, meets the whole force.
  blocks.reaction = blocks.nodal([](int, const Point&) { return Point{0.0, 2.0}; });
  EXPECT_NEAR(work->evaluate(blocks.context()), 0.5, 1e-15);
  blocks.move([&](int body, const Point& X) { return Point{corner(body, X, 1.0)[0], X[1] == 0.0 ? 0.1 : 0.0}; });
  EXPECT_NEAR(work->evaluate(blocks.context()), 0.5 + 5 * 2.0 * 0.1, 1e-14);
}

}  // namespace
}  // namespace mortise
