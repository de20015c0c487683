// Where bodies that slip come to rest against friction.

#include "mortise/simulation/run/diagnosis/friction_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mortise {
namespace {

const Sum alone = [](std::vector<double>&) {};

SlidingRow in_line(double bound, double slip) {
  TangentVector v(1);
  v[0] = slip;
  return {bound, 1.0, v, Eigen::MatrixXd::Ones(1, 1)};
}

Eigen::VectorXd load_of(std::initializer_list<double> values) {
  Eigen::VectorXd load(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), load.begin());
  return load;
}

/// The nodes of a block that is wider at its foot slip outwards. Sorted by slip, those left of one of them slip to the left, those right of it to the
/// right. This one bears the rest: the load that a body bears at rest.
TEST(FrictionBalance, InThePlaneOneNodeRests) {
  const std::vector<SlidingRow> rows{in_line(1.0, -3e-4), in_line(2.0, -1e-4), in_line(1.5, 0.2e-4), in_line(2.5, 1e-4), in_line(1.0, 4e-4)};
  const double all = 8.0;
  for (const double share : {-0.95, -0.5, -0.1, 0.0, 0.3, 0.6, 0.9, 0.99}) {
    const double load = share * all;
    const FrictionBalance balance = balance_friction(rows, load_of({load}), 1.0, alone);
    ASSERT_TRUE(balance.borne) << share;
    double borne = 0.0;
    int resting = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double t = balance.traction[i][0], v = rows[i].slip[0] + balance.motion[0];
      borne += t;
      EXPECT_LE(std::abs(t), rows[i].bound);
      if (std::abs(t) < (1.0 - 1e-6) * rows[i].bound) {
        ++resting;
        EXPECT_NEAR(v, 0.0, 1e-8);
      } else {
        EXPECT_GT(t * v, 0.0);
      }
    }
    EXPECT_NEAR(borne, load, 1e-9 * all) << share;
    EXPECT_EQ(resting, 1) << share;
  }
}

// Slips of a step that hardly changes anything, next to the size of the model. At a load of 1 two nodes bear it equally well.
TEST(FrictionBalance, InThePlaneOneNodeRestsHoweverSmallSlipsAre) {
  for (const double size : {1e-3, 1e-6, 1e-9}) {
    const std::vector<SlidingRow> rows{in_line(1.0, -3.0 * size), in_line(2.0, -1.0 * size), in_line(1.5, 0.2 * size), in_line(2.5, size)};
    for (const double load : {-4.0, -1.0, 0.0, 0.99999, 1.00001, 3.0}) {
      const FrictionBalance balance = balance_friction(rows, load_of({load}), 10.0, alone);
      ASSERT_TRUE(balance.borne) << size << ' ' << load;
      int resting = 0;
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (std::abs(balance.traction[i][0]) < (1.0 - 1e-6) * rows[i].bound) {
          ++resting;
          EXPECT_NEAR(rows[i].slip[0] + balance.motion[0], 0.0, 1e-3 * size);
        }
      EXPECT_EQ(resting, 1) << size << ' ' << load;
    }
  }
}

TEST(FrictionBalance, MoreThanFrictionBearsIsNotBorne) {
  const std::vector<SlidingRow> rows{in_line(1.0, -3e-4), in_line(2.0, -1e-4), in_line(1.5, 2e-4)};
  EXPECT_TRUE(balance_friction(rows, load_of({4.4}), 1.0, alone).borne);
  EXPECT_FALSE(balance_friction(rows, load_of({4.6}), 1.0, alone).borne);
  EXPECT_FALSE(balance_friction(rows, load_of({-4.6}), 1.0, alone).borne);
}

/// Four feet of a square that have slipped outwards, pushed and turned: all tractions have their bounds and the directions of their slips.
TEST(FrictionBalance, InSpaceFeetTurnTheirTractions) {
  std::vector<SlidingRow> rows;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      TangentVector v(2);
      v << 1e-3 * x, 1e-3 * y;
      Eigen::MatrixXd work(2, 3);
      work << 1.0, 0.0, -y, 0.0, 1.0, x;
      rows.push_back({1.0, 1.0, v, work});
    }
  const Eigen::VectorXd load = load_of({1.0, 0.5, 0.3});
  const FrictionBalance balance = balance_friction(rows, load, 1.0, alone);
  ASSERT_TRUE(balance.borne);
  Eigen::VectorXd left = load;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    left -= rows[i].work.transpose() * balance.traction[i];
    const TangentVector v = rows[i].slip + rows[i].work * balance.motion;
    EXPECT_NEAR((balance.traction[i] - v / v.norm()).norm(), 0.0, 1e-9);
  }
  EXPECT_LT(left.norm(), 1e-9);
}

}  // namespace
}  // namespace mortise
