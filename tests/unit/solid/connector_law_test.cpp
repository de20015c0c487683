// Laws of springs and dashpots against central differences and closed forms.

#include "mortise/solid/connector_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace mortise {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double h = 1e-6;

ConnectorLaw axial(double coefficient, double rest_length) {
  ConnectorLaw law;
  law.is_axial = true;
  law.axial = coefficient;
  law.rest_length = rest_length;
  return law;
}

template <class Function>
Matrix3d difference_quotient(const Function& force, const Vector3d& at) {
  Matrix3d result;
  for (int j = 0; j < 3; ++j) result.col(j) = (force(at + h * Vector3d::Unit(j)) - force(at - h * Vector3d::Unit(j))) / (2.0 * h);
  return result;
}

TEST(ConnectorLaw, TangentOfAnAxialSpringIsExactInLargeRotations) {
  const Vector3d start(1.0, 0.2, -0.3), motion(-2.5, 1.7, 0.9);
  const ConnectorLaw law = axial(3.0, 0.7);
  const ConnectorForce at = law.spring(start, motion);
  EXPECT_LT((at.by_motion - difference_quotient([&](const Vector3d& e) { return law.spring(start, e).force; }, motion)).norm(), 1e-8);
  const double length = (start + motion).norm();
  EXPECT_NEAR(at.along, 3.0 * (length - 0.7), 1e-14);
  EXPECT_NEAR(at.energy, 1.5 * std::pow(length - 0.7, 2), 1e-14);
  for (int i = 0; i < 3; ++i)  // the force is the gradient of the energy
    EXPECT_NEAR(at.force[i],
                (law.spring(start, motion + h * Vector3d::Unit(i)).energy - law.spring(start, motion - h * Vector3d::Unit(i)).energy) / (2.0 * h),
                1e-8);
}

TEST(ConnectorLaw, TangentsOfAnAxialDashpot) {
  const Vector3d start(1.0, 0.2, -0.3), motion(-2.5, 1.7, 0.9), velocity(0.4, -1.1, 0.6);
  const ConnectorLaw law = axial(2.0, 0.0);
  const ConnectorForce at = law.dashpot(start, motion, velocity);
  EXPECT_LT((at.by_motion - difference_quotient([&](const Vector3d& e) { return law.dashpot(start, e, velocity).force; }, motion)).norm(), 1e-8);
  EXPECT_LT((at.by_velocity - difference_quotient([&](const Vector3d& v) { return law.dashpot(start, motion, v).force; }, velocity)).norm(), 1e-8);
  const Vector3d n = (start + motion).normalized();
  EXPECT_NEAR(at.force.dot(velocity), 2.0 * std::pow(n.dot(velocity), 2), 1e-14);  // it takes power in any motion
}

TEST(ConnectorLaw, ARotationOfTheWholeChangesNoForceAlongTheLine) {
  const Vector3d start(1.0, 0.0, 0.0);
  const Matrix3d R = Eigen::AngleAxisd(2.0, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const ConnectorForce at = axial(5.0, 1.0).spring(start, R * start - start);
  EXPECT_NEAR(at.along, 0.0, 1e-14);
  EXPECT_NEAR(at.energy, 0.0, 1e-28);
}

TEST(ConnectorLaw, ComponentsAreLinear) {
  ConnectorLaw law;
  law.components = Vector3d(1.0, 0.0, 4.0);
  const Vector3d motion(0.5, 2.0, -0.25);
  EXPECT_EQ(law.spring(Vector3d::Zero(), motion).force, Vector3d(0.5, 0.0, -1.0));
  EXPECT_DOUBLE_EQ(law.spring(Vector3d::Zero(), motion).energy, 0.5 * (0.25 + 0.25));
  EXPECT_EQ(law.dashpot(Vector3d::Zero(), Vector3d::Zero(), motion).force, Vector3d(0.5, 0.0, -1.0));
}

}  // namespace
}  // namespace mortise
