#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mortise/shape/line2.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/triangle3.hpp"

namespace mortise {
namespace {

template <class Cell>
class ReferenceCell : public ::testing::Test {
 protected:
  // Points inside both reference cells.
  const std::vector<std::array<double, 2>> points{{0.1, 0.2}, {0.6, 0.15}, {0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0}, {0.25, 0.7}};
};
using Cells = ::testing::Types<Triangle3, Quadrilateral4>;
TYPED_TEST_SUITE(ReferenceCell, Cells);

TYPED_TEST(ReferenceCell, IsAPartitionOfUnityThatReproducesPosition) {
  for (const auto& xi : this->points) {
    const auto N = TypeParam::values(xi);
    const auto dN = TypeParam::gradients(xi);
    double sum = 0.0;
    std::array<double, 2> position{}, gradient{};
    std::array<std::array<double, 2>, 2> jacobian{};
    for (int a = 0; a < TypeParam::nodes; ++a) {
      sum += N[a];
      for (int i = 0; i < 2; ++i) {
        position[i] += N[a] * TypeParam::node_positions[a][i];
        gradient[i] += dN[a][i];
        for (int j = 0; j < 2; ++j) jacobian[i][j] += TypeParam::node_positions[a][i] * dN[a][j];
      }
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(position[i], xi[i], 1e-15);
      EXPECT_NEAR(gradient[i], 0.0, 1e-15);
      for (int j = 0; j < 2; ++j) EXPECT_NEAR(jacobian[i][j], i == j ? 1.0 : 0.0, 1e-15);
    }
  }
}

TYPED_TEST(ReferenceCell, InterpolatesAtItsNodes) {
  for (int b = 0; b < TypeParam::nodes; ++b) {
    const auto N = TypeParam::values(TypeParam::node_positions[b]);
    for (int a = 0; a < TypeParam::nodes; ++a) EXPECT_EQ(N[a], a == b ? 1.0 : 0.0);
  }
}

TYPED_TEST(ReferenceCell, GradientsAreTheCentralDifferencesOfTheValues) {
  const double h = 1e-5;
  for (const auto& xi : this->points) {
    const auto dN = TypeParam::gradients(xi);
    for (int i = 0; i < 2; ++i) {
      auto ahead = xi, behind = xi;
      ahead[i] += h;
      behind[i] -= h;
      const auto forward = TypeParam::values(ahead), backward = TypeParam::values(behind);
      // The functions are at most linear in each direction: only round-off remains.
      for (int a = 0; a < TypeParam::nodes; ++a) EXPECT_NEAR(dN[a][i], (forward[a] - backward[a]) / (2.0 * h), 1e-10);
    }
  }
}

TYPED_TEST(ReferenceCell, SidesRunCounterclockwiseWithTheirNormalOutward) {
  const auto& cell = topology(TypeParam::shape);
  ASSERT_EQ(cell.nodes, TypeParam::nodes);
  ASSERT_EQ(static_cast<int>(cell.sides.size()), TypeParam::nodes);
  for (const auto& side : cell.sides) {
    const auto &a = TypeParam::node_positions[side[0]], &b = TypeParam::node_positions[side[1]];
    const std::array<double, 2> normal{b[1] - a[1], a[0] - b[0]};
    const std::array<double, 2> outward{0.5 * (a[0] + b[0]) - TypeParam::centroid[0], 0.5 * (a[1] + b[1]) - TypeParam::centroid[1]};
    EXPECT_GT(normal[0] * outward[0] + normal[1] * outward[1], 0.0);
  }
}

TEST(Line2, IsAPartitionOfUnityWithItsGradients) {
  for (const double xi : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
    const auto N = Line2::values(xi);
    EXPECT_DOUBLE_EQ(N[0] + N[1], 1.0);
    EXPECT_NEAR(N[1] - N[0], xi, 1e-15);
    EXPECT_THAT(Line2::gradients(xi), ::testing::ElementsAre(-0.5, 0.5));
  }
}

}  // namespace
}  // namespace mortise
