// Projections of points between two lines.

#include <gtest/gtest.h>

#include "mortise/mortar/projection_2d.hpp"

namespace mortise {
namespace {

Point2<double> on(const SlaveLine<double>& slave, double xi, double distance) {
  const auto x = interpolate(slave.x, xi), n = interpolate(slave.normal, xi);
  return {x[0] + distance * n[0], x[1] + distance * n[1]};
}

SlaveLine<double> leaning(double first, double second) {
  return {{{{0.2, 0.1}, {1.7, 0.3}}}, {{{std::sin(first), -std::cos(first)}, {std::sin(second), -std::cos(second)}}}};
}

TEST(Projection, FindsTheParameterThatMadeThePoint) {
  for (const auto& [first, second] : {std::pair(-0.6, 0.7), {0.5, -0.4}, {0.3, 0.3}, {0.0, 0.0}, {-0.2, 0.9}}) {
    const auto slave = leaning(first, second);
    for (const double distance : {0.8, 0.1, 0.0, -0.1, -0.8})
      for (double xi = -0.95; xi < 1.0; xi += 0.19) {
        const auto found = project_back(slave, on(slave, xi, distance));
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->inside);
        EXPECT_NEAR(found->xi, xi, 1e-13);
        EXPECT_NEAR(lift_root(slave, on(slave, xi, distance), found->xi), xi, 1e-13);
      }
  }
}

TEST(Projection, ClipsToTheFacet) {
  const auto slave = leaning(-0.3, 0.4);
  const auto before = project_back(slave, {-3.0, -0.5}), behind = project_back(slave, {5.0, -0.5});
  ASSERT_TRUE(before && behind);
  EXPECT_EQ(before->xi, -1.0);
  EXPECT_FALSE(before->inside);
  EXPECT_EQ(behind->xi, 1.0);
  EXPECT_FALSE(behind->inside);
}

TEST(Projection, HasNoneBehindTheCrossingOfTheNormals) {
  // normals at +-45 degrees towards one another cross half a length below the middle
  const double c = std::sqrt(0.5);
  const SlaveLine<double> slave = {{{{-1.0, 0.0}, {1.0, 0.0}}}, {{{c, -c}, {-c, -c}}}};
  EXPECT_TRUE(project_back(slave, {0.0, -0.9}));
  EXPECT_FALSE(project_back(slave, {0.0, -1.1}));
}

// A point on the normal of a shared node is found inside one of its facets at most, and nowhere only if exactly on it: no double cover, no hole.
TEST(Projection, AgreesWithTheNeighbour) {
  for (int i = 0; i < 200; ++i) {
    const double lean = 0.8 * std::sin(1.0 + i);
    const Point2<double> shared = {1.0 + 0.1 * std::sin(3.0 * i), 0.1 * std::cos(5.0 * i)}, n = {std::sin(lean), -std::cos(lean)};
    const SlaveLine<double> left = {{{{0.0, 0.0}, shared}}, {{{0.0, -1.0}, n}}}, right = {{{shared, {2.0, 0.1}}}, {{n, {0.0, -1.0}}}};
    const double distance = 0.4 * std::cos(7.0 * i);
    const Point2<double> y = {shared[0] + distance * n[0], shared[1] + distance * n[1]};
    const auto end = project_back(left, y), start = project_back(right, y);
    ASSERT_TRUE(end && start);
    const double side = cross(difference(y, shared), n);  // round-off decides, but for both alike
    EXPECT_EQ(end->inside, side > 0.0);
    EXPECT_EQ(start->inside, side < 0.0);
    EXPECT_NEAR(end->xi, 1.0, 1e-12);
    EXPECT_NEAR(start->xi, -1.0, 1e-12);
  }
}

TEST(Projection, MeetsTheMasterAlongTheNormal) {
  const MasterLine<double> master = {{{{2.0, -1.0}, {-1.0, -0.4}}}};
  const auto projection = project_onto(master, {0.3, 0.2}, {0.4, -1.6});
  const auto y = interpolate(master.y, projection.eta);
  EXPECT_NEAR(0.3 + projection.distance * 0.4, y[0], 1e-15);
  EXPECT_NEAR(0.2 - projection.distance * 1.6, y[1], 1e-15);
}

}  // namespace
}  // namespace mortise
