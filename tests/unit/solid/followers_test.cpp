// Nodes that follow a reference point.

#include "mortise/solid/followers.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Tpetra_Vector.hpp>

#include "rigid_brick.hpp"

namespace mortise {
namespace {

// Rotation vectors of length 0, tiny, about 1 (where series end), and beyond half a turn.
class RotationVector : public testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(RotationVector, TurnsFollowersAndHasExactDerivatives) {
  const auto bodies = rigid_brick();
  const Mesh& mesh = *bodies->mesh();
  const ReferencePoint& point = mesh.reference_points[0];
  const Followers followers(*bodies);
  const Eigen::Vector3d theta = GetParam(), u(0.1, 0.2, -0.3), X(mesh.coordinates[point.node].data());
  const auto at = [&](const Eigen::Vector3d& turned) {
    Vector d(bodies->space().local_dofs());
    for (int i = 0; i < 3; ++i) {
      d.replaceLocalValue(3 * point.node + i, u[i]);
      d.replaceLocalValue(3 * point.rotation_node + i, point.arm * turned[i]);
    }
    return followers.evaluate(d);
  };
  const auto here = at(theta);
  const double angle = theta.norm();
  const Eigen::Matrix3d R = angle > 0.0 ? Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix() : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  ASSERT_EQ(here.size(), 3u * 26u);  // all nodes of the brick's surface
  for (std::size_t n = 0; n < here.size(); ++n) {
    const LocalOrdinal node = followers.dofs()[n] / 3, i = followers.dofs()[n] % 3;
    const Eigen::Vector3d arm = Eigen::Vector3d(mesh.coordinates[node].data()) - X;
    EXPECT_NEAR(here[n].value, (u + R * arm - arm)[i], 1e-14);
    ASSERT_EQ(here[n].sources, 4);
    EXPECT_EQ(here[n].gradient[0], 1.0);
  }
  // Central differences are wrong by h^2 / 6 times a third derivative and by round-off over h.
  const double h = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const auto forward = at(theta + h * Eigen::Vector3d::Unit(k)), back = at(theta - h * Eigen::Vector3d::Unit(k));
    for (std::size_t n = 0; n < here.size(); ++n) {
      EXPECT_NEAR(here[n].gradient[1 + k] * point.arm, (forward[n].value - back[n].value) / (2.0 * h), 1e-9);
      for (int l = 0; l < 3; ++l)
        EXPECT_NEAR(here[n].curvature[1 + k][1 + l] * point.arm, (forward[n].gradient[1 + l] - back[n].gradient[1 + l]) / (2.0 * h), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RotationVector,
                         testing::Values(Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(1e-9, -2e-9, 1e-9), Eigen::Vector3d(0.2, -0.1, 0.3),
                                         Eigen::Vector3d(0.6, 0.0, -0.8), Eigen::Vector3d(-0.7, 1.1, 0.4), Eigen::Vector3d(2.0, -1.5, 3.0)));

}  // namespace
}  // namespace mortise
