#include "search/yielding_sides.hpp"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace mortise {
namespace {

// A punch of the width 2 with its flat face at y = 0, and a slave facet at its right edge that rises by `theta` degrees.
struct PunchAndFacet {
  Positions<2> x = {{-1.0, 1.0}, {-1.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}, {1.0, 1.0}};
  std::vector<Facet<LocalOrdinal>> masters;
  Facet<LocalOrdinal> slave;

  explicit PunchAndFacet(double theta) {
    const double angle = theta * boost::math::double_constants::degree;
    for (const LocalOrdinal node : {0, 1, 2, 3}) masters.push_back({node, node + 1});  // left wall, face, right wall in two facets
    x.emplace_back(1.0 + std::cos(angle), std::sin(angle));
    x.emplace_back(1.0 - 0.1 * std::cos(angle), -0.1 * std::sin(angle));
    slave = {5, 6};
  }
  std::vector<char> yields() const { return yielding_facets(slave, masters, x); }
};

TEST(YieldingSides, WallsYieldToTheFaceUpTo30Degrees) {
  for (const double theta : {0.0, 4.0, 20.0, 28.0}) EXPECT_EQ(PunchAndFacet(theta).yields(), (std::vector<char>{1, 0, 1, 1})) << theta;
}

TEST(YieldingSides, TheFaceYieldsToTheWallBeyond) {
  for (const double theta : {62.0, 80.0, 89.0}) {
    const std::vector<char> yields = PunchAndFacet(theta).yields();
    EXPECT_EQ(yields[1], 1) << theta;
    EXPECT_EQ(yields[2], 0) << theta;
    EXPECT_EQ(yields[3], 0) << theta;
  }
}

TEST(YieldingSides, NeitherSideOfAWedgeYields) {
  for (const double theta : {35.0, 45.0, 55.0}) {
    const std::vector<char> yields = PunchAndFacet(theta).yields();
    EXPECT_EQ(yields[1], 0) << theta;
    EXPECT_EQ(yields[2], 0) << theta;
  }
}

TEST(YieldingSides, SidesAtABluntCornerAreBothTouched) {
  PunchAndFacet pair(20.0);
  pair.x[3] = {1.5, 0.4};  // 39 degrees
  pair.x[4] = {2.0, 0.8};
  const std::vector<char> yields = pair.yields();
  EXPECT_EQ(yields[1], 0);
  EXPECT_EQ(yields[2], 0);
  EXPECT_EQ(yields[3], 0);
}

TEST(YieldingSides, NothingYieldsAtAConcaveCorner) {
  Positions<2> x = {{-1.0, 1.0}, {0.0, 1.0}, {0.0, 0.0}, {1.0, 0.1}, {0.5, 0.1}};
  const std::vector<Facet<LocalOrdinal>> masters = {{2, 1}, {1, 0}};  // up a wall, then under a ceiling to the left
  x[0] = {1.0, 1.0};
  EXPECT_EQ(yielding_facets({3, 4}, masters, x), (std::vector<char>{0, 0}));
}

}  // namespace
}  // namespace mortise
