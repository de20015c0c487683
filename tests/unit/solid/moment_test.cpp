// Moments on reference points: the work they do, its derivative, the way back; full turns.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "mortise/input/expression.hpp"
#include "mortise/solid/full_turns.hpp"
#include "mortise/solid/loads.hpp"
#include "mortise/solid/rotation_vector.hpp"
#include "rigid_brick.hpp"

namespace mortise {
namespace {

using ::testing::HasSubstr;

constexpr double full = 2.0 * EIGEN_PI;

MomentOptions oblique() {
  MomentOptions options;
  options.point.value = "point";
  options.moment_vector = {parse_expression("3*t", {}), ScalarFunction(-2.0), parse_expression("1 + t", {})};
  return options;
}

const Eigen::Vector3d moment(1.5, -2.0, 1.5);  // of oblique() at t = 0.5

Eigen::Matrix3d rotation(const Eigen::Vector3d& theta) {
  const double angle = theta.norm();
  return angle > 0.0 ? Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix() : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

/// -f_ext of oblique() at t = 0.5.
Eigen::VectorXd residual(const Bodies& bodies, const Load& load, const Eigen::VectorXd& u) {
  Vector r(bodies.space().dofs());
  std::optional<StepFailure> failure;
  load.add_residual(0.5, to_local(bodies, u), r, failure);
  EXPECT_FALSE(failure) << failure->what();
  return to_eigen(r);
}

// Length 0, tiny, about 1 (where series end), beyond half a turn, about a full one, beyond it.
class MomentInSpace : public testing::TestWithParam<Eigen::Vector3d> {};

// W = m . d omega, where dR R^T = [d omega]x, with R by Eigen and dR by central differences, wrong by h^2 / 6 and by round-off over h.
TEST_P(MomentInSpace, WorksOnTheSpin) {
  const auto bodies = rigid_brick();
  const ReferencePoint& point = bodies->mesh()->reference_points[0];
  const auto load = oblique().make(bodies);
  const Eigen::VectorXd r = residual(*bodies, *load, turned_by(*bodies, GetParam()));
  const double h = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
    const Eigen::Matrix3d W = (rotation(GetParam() + step) - rotation(GetParam() - step)) / (2.0 * h) * rotation(GetParam()).transpose();
    const Eigen::Vector3d spin_rate(W(2, 1), W(0, 2), W(1, 0));
    EXPECT_NEAR(-r(3 * point.rotation_node + k) * point.arm, moment.dot(spin_rate), 1e-9 * moment.norm());
    EXPECT_LE((spin(GetParam()).col(k) - spin_rate).norm(), 1e-9);
  }
  Eigen::VectorXd others = r;
  others.segment<3>(3 * point.rotation_node).setZero();
  EXPECT_EQ(others.norm(), 0.0);
}

TEST_P(MomentInSpace, JacobianIsTheDerivativeOfItsForce) {
  const auto bodies = rigid_brick();
  const auto load = oblique().make(bodies);
  ASSERT_TRUE(load->follows());
  const Eigen::VectorXd u = turned_by(*bodies, GetParam());
  Matrix matrix(bodies->space().graph());
  std::optional<StepFailure> failure;
  load->add_jacobian(0.5, to_local(*bodies, u), matrix, failure);
  ASSERT_FALSE(failure);
  const Eigen::MatrixXd K = to_dense(matrix);
  const auto at = [&](const Eigen::VectorXd& v) { return residual(*bodies, *load, v); };
  EXPECT_LE((K - central_differences(at, u, 1e-5)).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff());
  EXPECT_GE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff()) << "a moment of fixed direction has no potential";
}

TEST_P(MomentInSpace, IsFoundFromItsForce) {
  const Eigen::Vector3d generalised = generalised_moment(GetParam(), moment).value;
  const double least = 2.0 * std::abs(std::sin(0.5 * GetParam().norm())) / std::max(1e-300, GetParam().norm());
  if (GetParam().norm() > 0.0) EXPECT_NEAR(least_spin(GetParam(), {true, true, true}), std::min(1.0, least), 1e-14);
  EXPECT_LE((spatial_moment(GetParam(), generalised) - moment).norm(), 1e-14 / std::max(1e-3, least) * moment.norm());
}

INSTANTIATE_TEST_SUITE_P(All, MomentInSpace,
                         testing::Values(Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(1e-9, -2e-9, 1e-9), Eigen::Vector3d(0.2, -0.1, 0.3),
                                         Eigen::Vector3d(0.6, 0.0, -0.8), Eigen::Vector3d(-0.7, 1.1, 0.4), Eigen::Vector3d(2.0, -1.5, 3.0),
                                         (full - 1e-2) * Eigen::Vector3d(2.0, -1.0, 2.0) / 3.0, Eigen::Vector3d(4.0, 5.0, -3.0)));

TEST(FullTurn, HasNoMomentAcrossTheAxis) {
  const Eigen::Vector3d axis(0.6, 0.0, 0.8), theta = full * axis, generalised = generalised_moment(theta, moment).value;
  EXPECT_LE((generalised - axis * axis.dot(moment)).norm(), 1e-14);
  EXPECT_TRUE(spatial_moment(theta, generalised).array().isNaN().all());
  EXPECT_EQ(spatial_moment(theta, Eigen::Vector3d::Zero()).norm(), 0.0);
}

/// Message about a point turned by theta whose components in `prescribed` are prescribed.
std::string refusal(const Eigen::Vector3d& theta, const std::vector<int>& prescribed) {
  const auto bodies = rigid_brick();
  std::vector<LocalOrdinal> dofs;
  for (const int i : prescribed) dofs.push_back(3 * bodies->mesh()->reference_points[0].rotation_node + i);
  std::optional<StepFailure> failure;
  FullTurns(*bodies, dofs).check(to_local(*bodies, turned_by(*bodies, theta)), failure);
  if (!failure) return "none";
  EXPECT_EQ(failure->kind(), FailureKind::linear_solver);
  return failure->what();
}

TEST(FullTurn, IsAFailureWhereComponentsAcrossItAreFree) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), axis(0.0, 0.6, 0.8);
  EXPECT_THAT(refusal(full * z, {}), HasSubstr("the rotation vector of \"point\" has come to 360.0000 degrees"));
  EXPECT_THAT(refusal(2.0 * full * axis, {}), HasSubstr("720.0000 degrees"));
  EXPECT_THAT(refusal(full * z, {0, 2}), HasSubstr("full turn"));
  EXPECT_THAT(refusal(full * axis, {0}), HasSubstr("full turn"));
  EXPECT_EQ(refusal(full * z, {0, 1, 2}), "none");
  EXPECT_EQ(refusal(full * z, {0, 1}), "none");
  EXPECT_EQ(refusal(full * axis, {0, 1}), "none");
  EXPECT_EQ(refusal(Eigen::Vector3d::Zero(), {}), "none");
  // 2 |sin(t/2)| / t = 1e-4 at 2 pi (1 - 1e-4), to first order
  EXPECT_EQ(refusal((1.0 - 1.1e-4) * full * z, {}), "none");
  EXPECT_THAT(refusal((1.0 - 0.9e-4) * full * z, {}), HasSubstr("full turn"));
}

TEST(Moment, IsNamedByThePlaneOrBySpace) {
  const auto message = [](const MomentOptions& options) -> std::string {
    try {
      options.make(rigid_brick());
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  MomentOptions options = oblique();
  options.moment = parse_expression("t", {}, {"scene.xml", 7, "loads/twist"});
  EXPECT_THAT(message(options), HasSubstr("scene.xml:7"));
  EXPECT_THAT(message(options), HasSubstr("\"moment\" is for 2D, the model is in 3D; please give \"moment x\", \"moment y\", \"moment z\""));
  options = {};
  options.point = {"point", {"scene.xml", 9, "loads/twist"}};
  EXPECT_THAT(message(options), HasSubstr("scene.xml:9: error: loads/twist: a moment on \"point\" without a value; please give \"moment x\""));
}

}  // namespace
}  // namespace mortise
