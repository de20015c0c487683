#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "mortise/shape/hexahedron20.hpp"
#include "mortise/shape/hexahedron8.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/line3.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/tetrahedron10.hpp"
#include "mortise/shape/tetrahedron4.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {
namespace {

template <class Cell>
class ReferenceCell : public ::testing::Test {
 protected:
  static constexpr int dimension = Cell::dimension;
  using Position = std::array<double, dimension>;

  /// Points inside all reference cells of the dimension.
  std::vector<Position> points() const {
    std::vector<Position> result;
    for (const auto& point : std::vector<std::array<double, 3>>{
             {0.1, 0.2, 0.3}, {0.6, 0.15, 0.2}, {0.0, 0.0, 0.0}, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.25, 0.7, 0.04}}) {
      result.emplace_back();
      std::copy_n(point.begin(), dimension, result.back().begin());
    }
    return result;
  }

  static Eigen::Matrix<double, dimension, 1> node(int a) {
    return Eigen::Map<const Eigen::Matrix<double, dimension, 1>>(Cell::node_positions[a].data());
  }
};
using Cells = ::testing::Types<Triangle3, Triangle6, Quadrilateral4, Quadrilateral8, Tetrahedron4, Tetrahedron10, Hexahedron8, Hexahedron20>;
TYPED_TEST_SUITE(ReferenceCell, Cells);

TYPED_TEST(ReferenceCell, IsAPartitionOfUnityThatReproducesPosition) {
  constexpr int dimension = TypeParam::dimension;
  for (const auto& xi : this->points()) {
    const auto N = TypeParam::values(xi);
    const auto dN = TypeParam::gradients(xi);
    double sum = 0.0;
    typename TestFixture::Position position{}, gradient{};
    std::array<std::array<double, dimension>, dimension> jacobian{};
    for (int a = 0; a < TypeParam::nodes; ++a) {
      sum += N[a];
      for (int i = 0; i < dimension; ++i) {
        position[i] += N[a] * TypeParam::node_positions[a][i];
        gradient[i] += dN[a][i];
        for (int j = 0; j < dimension; ++j) jacobian[i][j] += TypeParam::node_positions[a][i] * dN[a][j];
      }
    }
    const double round_off = 1e-16 * TypeParam::nodes;
    EXPECT_NEAR(sum, 1.0, round_off);
    for (int i = 0; i < dimension; ++i) {
      EXPECT_NEAR(position[i], xi[i], round_off);
      EXPECT_NEAR(gradient[i], 0.0, 4.0 * round_off);
      for (int j = 0; j < dimension; ++j) EXPECT_NEAR(jacobian[i][j], i == j ? 1.0 : 0.0, 4.0 * round_off);
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
  for (const auto& xi : this->points()) {
    const auto dN = TypeParam::gradients(xi);
    for (int i = 0; i < TypeParam::dimension; ++i) {
      auto ahead = xi, behind = xi;
      ahead[i] += h;
      behind[i] -= h;
      const auto forward = TypeParam::values(ahead), backward = TypeParam::values(behind);
      // The functions are at most quadratic in each direction: only round-off remains.
      for (int a = 0; a < TypeParam::nodes; ++a) EXPECT_NEAR(dN[a][i], (forward[a] - backward[a]) / (2.0 * h), 1e-10);
    }
  }
}

TYPED_TEST(ReferenceCell, CornersOfSidesRunWithTheNormalOutward) {
  using Vector = Eigen::Matrix<double, TypeParam::dimension, 1>;
  const auto& cell = topology(TypeParam::shape);
  ASSERT_EQ(cell.nodes, TypeParam::nodes);
  ASSERT_EQ(cell.dimension, TypeParam::dimension);
  const Vector centre = Eigen::Map<const Vector>(TypeParam::centroid.data());
  Vector closed = Vector::Zero();  // of a closed surface the area vectors sum to zero
  for (const auto& side : cell.sides) {
    ASSERT_EQ(static_cast<int>(side.size()), topology(cell.side).nodes);
    const int corners = topology(cell.side).corners;
    Vector middle = Vector::Zero(), normal = Vector::Zero();
    for (int c = 0; c < corners; ++c) {
      const Vector a = this->node(side[c]), b = this->node(side[(c + 1) % corners]);
      middle += a / corners;
      if constexpr (TypeParam::dimension == 2)
        normal = c == 0 ? Vector(b(1) - a(1), a(0) - b(0)) : normal;
      else
        normal += 0.5 * a.cross(b);
    }
    EXPECT_GT(normal.dot(middle - centre), 0.0);
    closed += normal;
  }
  EXPECT_LE(closed.norm(), 1e-15);
}

TYPED_TEST(ReferenceCell, NodesBeyondTheCornersStandInTheMiddleOfTheEdges) {
  const auto& cell = topology(TypeParam::shape);
  const int corners = topology(cell.side).corners;
  for (const auto& side : cell.sides)
    for (int n = corners; n < static_cast<int>(side.size()); ++n) {
      const int c = n - corners;  // of lines: the one between both
      EXPECT_LE((this->node(side[n]) - 0.5 * (this->node(side[c]) + this->node(side[(c + 1) % corners]))).norm(), 1e-16);
    }
}

TEST(Lines, ArePartitionsOfUnityWithTheirGradients) {
  const double h = 1e-5;
  for (const double xi : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
    const auto N = Line2::values(xi);
    EXPECT_DOUBLE_EQ(N[0] + N[1], 1.0);
    EXPECT_NEAR(N[1] - N[0], xi, 1e-15);
    EXPECT_THAT(Line2::gradients(xi), ::testing::ElementsAre(-0.5, 0.5));
    const auto Q = Line3::values(xi), ahead = Line3::values(xi + h), behind = Line3::values(xi - h);
    EXPECT_NEAR(Q[0] + Q[1] + Q[2], 1.0, 1e-15);
    EXPECT_NEAR(Q[1] - Q[0], xi, 1e-15);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(Line3::gradients(xi)[a], (ahead[a] - behind[a]) / (2.0 * h), 1e-10);
  }
  EXPECT_THAT(Line3::values(-1.0), ::testing::ElementsAre(1.0, 0.0, 0.0));
  EXPECT_THAT(Line3::values(1.0), ::testing::ElementsAre(0.0, 1.0, 0.0));
  EXPECT_THAT(Line3::values(0.0), ::testing::ElementsAre(0.0, 0.0, 1.0));
}

}  // namespace
}  // namespace mortise
