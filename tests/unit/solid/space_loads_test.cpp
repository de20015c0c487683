// Loads and prescribed motions in 3D: resultants, equilibrium, and the follower pressure's tangent on sides of every shape.

#include <gtest/gtest.h>

#include "mortise/input/expression.hpp"
#include "mortise/solid/loads.hpp"
#include "mortise/solid/prescribed_motion.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

std::shared_ptr<Bodies> brick_of(ElementType element, double distortion) {
  BrickSetup setup;
  setup.element = element;
  setup.cells = {2, 2, 1};
  setup.distortion = distortion;
  setup.curved = element == ElementType::h20;
  return make_brick(setup);
}

/// f_ext at time t.
Eigen::VectorXd force(const Bodies& bodies, const Load& load, const Eigen::VectorXd& u, double t = 1.0) {
  Vector residual(bodies.space().dofs());
  std::optional<StepFailure> failure;
  load.add_residual(t, to_local(bodies, u), residual, failure);
  EXPECT_FALSE(failure) << failure->what();
  return -to_eigen(residual);
}

Eigen::Vector3d sum(const Eigen::VectorXd& f) {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (Eigen::Index n = 0; n < f.size(); n += 3) total += f.segment<3>(n);
  return total;
}

Eigen::VectorXd at_rest(const Bodies& bodies) { return Eigen::VectorXd::Zero(3 * bodies.mesh()->local_count()); }

Eigen::VectorXd bent(const Bodies& bodies) {
  return space_field(bodies, [](const Point3& X) -> Point3 {
    return {0.1 * std::sin(X[0] + 2.0 * X[1] - X[2]), 0.12 * std::cos(3.0 * X[0] - X[1] + X[2]), 0.1 * std::sin(2.0 * X[0] + X[1] + 2.0 * X[2])};
  });
}

TEST(SpaceLoads, NodalForceIsTheValueAtEachNode) {
  const auto bodies = brick_of(ElementType::h8, 0.0);
  NodalForceOptions options;
  options.set.value = "body/top";
  options.x = parse_expression("2*t*x", {});
  options.z = parse_expression("-3*z*y", {});
  const Eigen::VectorXd f = force(*bodies, *options.make(bodies), bent(*bodies), 0.5);
  for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node) {
    const auto& X = bodies->mesh()->coordinates[node];
    const bool top = std::abs(X[2] - 1.0) < 1e-12;
    EXPECT_DOUBLE_EQ(f(3 * node), top ? X[0] : 0.0);
    EXPECT_DOUBLE_EQ(f(3 * node + 1), 0.0);
    EXPECT_DOUBLE_EQ(f(3 * node + 2), top ? -3.0 * X[1] : 0.0);
  }
}

TEST(SpaceLoads, DeadTractionHasTheResultantOfItsIntegral) {
  for (const ElementType element : elements_of(3)) {
    const auto bodies = brick_of(element, 0.0);
    DeadTractionOptions options;
    options.set.value = "body/top";
    options.x = parse_expression("t*x^2*y", {});
    options.y = -5.0;
    options.z = parse_expression("y^3", {});
    // On z = 1, x in [2, 3], y in [0, 1]; x^2 y N is of degree 5 at most.
    const Eigen::Vector3d expected(2.0 * (27.0 - 8.0) / 3.0 * 0.5, -5.0, 0.25);
    EXPECT_LE((sum(force(*bodies, *options.make(bodies), bent(*bodies), 2.0)) - expected).norm(), 1e-13 * expected.norm()) << to_string(element);
  }
}

TEST(SpaceLoads, SurfaceForceIsATractionOfTheForceOverTheArea) {
  for (const ElementType element : elements_of(3)) {
    const auto bodies = brick_of(element, 0.0);
    SurfaceForceOptions options;
    options.set.value = "body/top";  // of area 1
    options.x = parse_expression("3*t", {});
    options.y = -5.0;
    options.z = ScalarFunction(7.0);
    DeadTractionOptions traction;
    traction.set.value = "body/top";
    traction.x = 6.0;
    traction.y = -5.0;
    traction.z = ScalarFunction(7.0);
    const Eigen::VectorXd f = force(*bodies, *options.make(bodies), bent(*bodies), 2.0);
    EXPECT_LE((f - force(*bodies, *traction.make(bodies), bent(*bodies), 2.0)).cwiseAbs().maxCoeff(), 1e-13) << to_string(element);
    EXPECT_LE((sum(f) - Eigen::Vector3d(6.0, -5.0, 7.0)).norm(), 1e-13) << to_string(element);
  }
}

TEST(SpaceLoads, DeadTractionHoldsTheStressItStandsFor) {
  // A homogeneous first Piola-Kirchhoff stress P is in equilibrium with T = P N on all sides.
  Matrix3 F;
  F << 1.1, 0.05, -0.02, 0.02, 0.93, 0.04, 0.03, -0.05, 1.02;
  const Matrix3 P = Hencky(ElasticConstants{1000.0, 0.3}).stress(F) * F.inverse().transpose();
  const std::vector<std::pair<std::string, Eigen::Vector3d>> sides{{"body/right", {1, 0, 0}}, {"body/left", {-1, 0, 0}},
                                                                   {"body/back", {0, 1, 0}},  {"body/front", {0, -1, 0}},
                                                                   {"body/top", {0, 0, 1}},   {"body/bottom", {0, 0, -1}}};
  for (const ElementType element : elements_of(3)) {
    const auto bodies = brick_of(element, 0.0);
    const Eigen::VectorXd u = space_field(*bodies, [&](const Point3& X) -> Point3 {
      const Eigen::Vector3d moved = (F - Matrix3::Identity()) * Eigen::Map<const Eigen::Vector3d>(X.data());
      return {moved(0), moved(1), moved(2)};
    });
    Eigen::VectorXd out_of_balance = internal_force(*bodies, u);
    const double scale = out_of_balance.cwiseAbs().maxCoeff();
    for (const auto& [set, N] : sides) {
      const Eigen::Vector3d T = P * N;
      DeadTractionOptions options;
      options.set.value = set;
      options.x = T(0);
      options.y = T(1);
      options.z = ScalarFunction(T(2));
      out_of_balance -= force(*bodies, *options.make(bodies), u);
    }
    EXPECT_LE(out_of_balance.cwiseAbs().maxCoeff(), 1e-12 * scale) << to_string(element);
  }
}

TEST(SpaceLoads, FollowerPressurePushesAgainstTheOutwardNormal) {
  for (const ElementType element : elements_of(3)) {
    const auto bodies = brick_of(element, 0.0);
    FollowerPressureOptions options;
    options.set.value = "body/back";
    options.pressure = 4.0;
    EXPECT_LE((sum(force(*bodies, *options.make(bodies), at_rest(*bodies))) - Eigen::Vector3d(0.0, -4.0, 0.0)).norm(), 1e-13) << to_string(element);
    options.set.value = "body/surface";
    EXPECT_LE(sum(force(*bodies, *options.make(bodies), bent(*bodies))).norm(), 4e-13) << to_string(element);
  }
}

TEST(SpaceLoads, FollowerPressureIsTheDerivativeOfPressureTimesVolume) {
  // Work of uniform pressure on a closed surface: -p dV. (Four points do not integrate the volume of bent quadratic tetrahedra exactly.)
  for (const ElementType element : {ElementType::h8, ElementType::tet4, ElementType::h20}) {
    const auto bodies = brick_of(element, 0.1);
    FollowerPressureOptions options;
    options.set.value = "body/surface";
    options.pressure = 4.0;
    const Eigen::VectorXd u = bent(*bodies);
    const auto volume = [&](const Eigen::VectorXd& v) {
      double total = 0.0;
      bodies->visit_points(to_local(*bodies, v), [&](const MaterialPoint& point) { total += point.weight * point.volume_ratio; });
      return Eigen::VectorXd::Constant(1, total);
    };
    const Eigen::VectorXd f = force(*bodies, *options.make(bodies), u);
    EXPECT_LE((f + 4.0 * central_differences(volume, u, 1e-5).row(0).transpose()).cwiseAbs().maxCoeff(), 1e-6 * f.cwiseAbs().maxCoeff())
        << to_string(element);
  }
}

std::string refusal(const std::function<void()>& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_tangent(const std::shared_ptr<Bodies>& bodies, const LoadOptions& options, const Eigen::VectorXd& u) {
  const auto load = options.make(bodies);
  ASSERT_TRUE(load->follows());
  Matrix matrix(bodies->space().graph());
  std::optional<StepFailure> failure;
  load->add_jacobian(2.0, to_local(*bodies, u), matrix, failure);
  ASSERT_FALSE(failure);
  const Eigen::MatrixXd K = to_dense(matrix);
  const auto minus_force = [&](const Eigen::VectorXd& v) { return Eigen::VectorXd(-force(*bodies, *load, v, 2.0)); };
  EXPECT_LE((K - central_differences(minus_force, u)).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff());
}

void expect_follower_tangent(const std::shared_ptr<Bodies>& bodies, const std::string& set, const std::string& pressure, const Eigen::VectorXd& u) {
  SCOPED_TRACE(set);
  FollowerPressureOptions options;
  options.set.value = set;
  options.pressure = parse_expression(pressure, {});
  expect_tangent(bodies, options, u);
}

TEST(SpaceLoads, FollowerPressureJacobianIsTheDerivativeOfItsForce) {
  for (const ElementType element : elements_of(3))
    for (const char* set : {"body/surface", "body/right"}) {
      const auto bodies = brick_of(element, 0.1);
      expect_follower_tangent(bodies, set, "t*(1+x*y*z)", bent(*bodies));
    }
}

TEST(SidesInThePlane, CarryTractionAndFollowerPressure) {
  for (const ElementType element : elements_of(2))
    for (const Kinematics kinematics : {Kinematics::plane_strain, Kinematics::axisymmetric}) {
      BodySetup setup;
      setup.element = element;
      setup.kinematics = kinematics;
      const auto bodies = make_test_bodies(self(), setup);
      const Eigen::VectorXd u = to_eigen(local_field(*bodies, [](double X, double Y) -> std::array<double, 2> {
        return {0.1 * std::sin(X + 2.0 * Y), 0.15 * std::cos(3.0 * X - Y)};
      }));
      expect_follower_tangent(bodies, "body/surface", "t*(1+x*y)", u);
      DeadTractionOptions options;
      options.set.value = "body/top";
      options.y = parse_expression("x^2", {});
      const Eigen::VectorXd f = force(*bodies, *options.make(bodies), u);
      double total = 0.0;
      for (Eigen::Index n = 1; n < f.size(); n += 2) total += f(n);
      // On y = 1, x in [2, 3]: of x^2 times the thickness 0.7, or 2 pi x.
      const double expected = kinematics == Kinematics::axisymmetric ? 2.0 * EIGEN_PI * (81.0 - 16.0) / 4.0 : 0.7 * (27.0 - 8.0) / 3.0;
      EXPECT_NEAR(total, expected, 1e-13 * expected);
    }
}

// On [2, 3] x [0, 1] x [0, 1] with density 2, about the axis through (1, 0.25, 5) along z or along another direction e: omega^2 m P (x - c) of the
// centre of mass.
TEST(SpaceLoads, CentrifugalForceIsThatOfTheCentreOfMass) {
  for (const ElementType element : elements_of(3)) {
    const auto bodies = brick_of(element, 0.0);
    const Eigen::VectorXd moved = space_field(*bodies, [](const Point3&) -> Point3 { return {0.1, -0.2, 0.3}; });
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0, 0, -2), Eigen::Vector3d(1, 2, 2)}) {
      CentrifugalOptions options;
      options.speed = parse_expression("3*t", {});
      options.point = {1.0, 0.25, 5.0};
      options.axis = {axis(0), axis(1), axis(2)};
      const Eigen::Vector3d e = axis.normalized(), arm = Eigen::Vector3d(2.6, 0.3, 0.8) - Eigen::Vector3d(1.0, 0.25, 5.0);
      const Eigen::Vector3d expected = 2.25 * 2.0 * (arm - e * e.dot(arm));
      EXPECT_LE((sum(force(*bodies, *options.make(bodies), moved, 0.5)) - expected).norm(), 1e-12 * expected.norm()) << to_string(element);
      expect_tangent(bodies, options, bent(*bodies));
    }
  }
}

TEST(SpaceLoads, CentrifugalForceRefusesWhatIsNoAxis) {
  const auto bodies = brick_of(ElementType::h8, 0.0);
  CentrifugalOptions options;
  options.body.place = {"scene.xml", 7, "loads/spin"};
  EXPECT_NE(refusal([&] { options.make(bodies); }).find("scene.xml:7: error: loads/spin: \"axis\" has to be a direction"), std::string::npos);
  options.axis = {0.0, 0.0, 1.0};
  options.point = {0.0, 1.0};
  EXPECT_NE(refusal([&] { options.make(bodies); }).find("\"point\" has 2 numbers; this 3D model needs 3"), std::string::npos);
  options.point.clear();
  options.body.value = "bdy";
  EXPECT_NE(refusal([&] { options.make(bodies); }).find("there is no body \"bdy\"; the bodies are: body"), std::string::npos);
}

TEST(SpaceLoads, GravityHasTheWeightOfTheBody) {
  for (const ElementType element : elements_of(3)) {
    const auto bodies = brick_of(element, 0.0);
    GravityOptions options;
    options.z = parse_expression("-9.81*t", {});
    const Eigen::Vector3d weight = sum(force(*bodies, *options.make(bodies), bent(*bodies), 0.5));
    EXPECT_LE((weight - Eigen::Vector3d(0.0, 0.0, -0.5 * 9.81 * 2.0)).norm(), 1e-12) << to_string(element);
  }
}

TEST(SpaceLoads, AndConditionsInZAreRefusedInThePlane) {
  const auto flat = make_test_bodies(self(), {});
  const Place place{"scene.xml", 8, "loads/push"};
  NodalForceOptions nodal;
  nodal.set.value = "body/top";
  DeadTractionOptions traction;
  traction.set.value = "body/top";
  GravityOptions gravity;
  nodal.z = traction.z = gravity.z = parse_expression("1+t", {}, place);
  for (const LoadOptions* options : std::initializer_list<const LoadOptions*>{&nodal, &traction, &gravity}) {
    const std::string error = refusal([&] { options->make(flat); });
    EXPECT_NE(error.find("scene.xml:8"), std::string::npos) << error;
    EXPECT_NE(error.find("in z"), std::string::npos) << error;
    EXPECT_NE(error.find("\"three dimensional\""), std::string::npos) << error;
  }
  Named<BoundaryConditionOptions> condition{"hold", place, {}};
  condition.value.set = {"body/left", place};
  condition.value.z = ScalarFunction(0.0);
  const std::string error = refusal([&] { PrescribedMotion(*flat, {condition}); });
  EXPECT_NE(error.find("scene.xml:8"), std::string::npos) << error;
  EXPECT_NE(error.find("prescribes z"), std::string::npos) << error;
}

TEST(SpacePrescribedMotion, HoldsTheNamedComponentsAscending) {
  const auto bodies = brick_of(ElementType::tet4, 0.0);
  Named<BoundaryConditionOptions> right{"right", {}, {}}, bottom{"bottom", {}, {}};
  right.value.set.value = "body/right";
  right.value.x = parse_expression("2*t*y*z", {});
  bottom.value.set.value = "body/bottom";
  bottom.value.z = parse_expression("0.5*x", {});
  const PrescribedMotion motion(*bodies, {right, bottom});
  std::vector<LocalOrdinal> dofs;
  std::vector<double> values;
  for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node) {
    const auto& X = bodies->mesh()->coordinates[node];
    if (std::abs(X[0] - 3.0) < 1e-12) dofs.push_back(3 * node), values.push_back(2.0 * 0.25 * X[1] * X[2]);
    if (std::abs(X[2]) < 1e-12) dofs.push_back(3 * node + 2), values.push_back(0.5 * X[0]);
  }
  EXPECT_EQ(motion.dofs(), dofs);
  std::optional<StepFailure> failure;
  const auto actual = motion.values(0.25, failure);
  EXPECT_FALSE(failure);
  ASSERT_EQ(actual.size(), values.size());
  for (std::size_t n = 0; n < values.size(); ++n) EXPECT_DOUBLE_EQ(actual[n], values[n]);
  // Two values of z at one node are named with its place.
  Named<BoundaryConditionOptions> other{"other", {}, {}};
  other.value.set.value = "body/bottom";
  other.value.z = ScalarFunction(1.0);
  const std::string error = refusal([&] { PrescribedMotion(*bodies, {bottom, other}); });
  EXPECT_NE(error.find("prescribe z differently"), std::string::npos) << error;
}

}  // namespace
}  // namespace mortise
