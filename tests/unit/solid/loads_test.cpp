// Loads: resultants, and the follower pressure's tangent.

#include "mortise/solid/loads.hpp"

#include <gtest/gtest.h>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/input/expression.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

std::shared_ptr<Bodies> bodies_of(Kinematics kinematics, ElementType element = ElementType::q4) {
  BodySetup setup;
  setup.kinematics = kinematics;
  setup.element = element;
  setup.law = kinematics == Kinematics::plane_stress ? "st venant kirchhoff" : "hencky";
  return make_test_bodies(self(), setup);
}

/// f_ext at time t.
Eigen::VectorXd force(const Bodies& bodies, const Load& load, const Eigen::VectorXd& u, double t = 1.0) {
  Vector residual(bodies.space().dofs());
  std::optional<StepFailure> failure;
  load.add_residual(t, to_local(bodies, u), residual, failure);
  EXPECT_FALSE(failure) << failure->what();
  return -to_eigen(residual);
}

double sum(const Eigen::VectorXd& f, int component) {
  double total = 0.0;
  for (Eigen::Index n = component; n < f.size(); n += 2) total += f(n);
  return total;
}

Eigen::VectorXd bent(const Bodies& bodies) {
  return to_eigen(local_field(bodies, [](double X, double Y) -> std::array<double, 2> {
    return {0.1 * std::sin(X + 2.0 * Y), 0.15 * std::cos(3.0 * X - Y)};
  }));
}

TEST(NodalForce, IsTheValueAtEachNode) {
  const auto bodies = bodies_of(Kinematics::plane_strain);
  NodalForceOptions options;
  options.set.value = "body/top";
  options.x = parse_expression("2*t*x", {});
  options.y = -3.0;
  const auto load = options.make(bodies);
  const Eigen::VectorXd f = force(*bodies, *load, bent(*bodies), 0.5);
  for (LocalOrdinal node = 0; node < bodies->mesh()->owned_count(); ++node) {
    const auto& X = bodies->mesh()->coordinates[node];
    const bool top = std::abs(X[1] - 1.0) < 1e-12;
    EXPECT_DOUBLE_EQ(f(2 * node), top ? X[0] : 0.0);
    EXPECT_DOUBLE_EQ(f(2 * node + 1), top ? -3.0 : 0.0);
  }
  EXPECT_FALSE(load->follows());
}

TEST(DeadTraction, HasTheResultantOfItsIntegral) {
  for (const auto& [name, kinematics] : kinematics_names()) {
    if (dimension(kinematics) == 3) continue;
    const auto bodies = bodies_of(kinematics);
    DeadTractionOptions options;
    options.set.value = "body/top";
    options.x = parse_expression("t*x^2", {});
    options.y = -5.0;
    const Eigen::VectorXd f = force(*bodies, *options.make(bodies), bent(*bodies), 2.0);
    // On y = 1 between x = 2 and 3: integrals of 2 x^2 and of -5, times the thickness 0.7 or with 2 pi x under the integral.
    const bool axisymmetric = kinematics == Kinematics::axisymmetric;
    const double x = axisymmetric ? 2.0 * 2.0 * EIGEN_PI * (81.0 - 16.0) / 4.0 : 0.7 * 2.0 * (27.0 - 8.0) / 3.0;
    const double y = axisymmetric ? -5.0 * EIGEN_PI * (9.0 - 4.0) : 0.7 * -5.0;
    EXPECT_NEAR(sum(f, 0), x, 1e-13 * std::abs(x)) << name;
    EXPECT_NEAR(sum(f, 1), y, 1e-13 * std::abs(y)) << name;
  }
}

TEST(DeadTraction, HoldsTheStressItStandsFor) {
  // A homogeneous first Piola-Kirchhoff stress P is in equilibrium with T = P N on all sides.
  const auto bodies = bodies_of(Kinematics::plane_strain, ElementType::t3);
  const Eigen::VectorXd u = to_eigen(local_field(*bodies, [](double X, double Y) -> std::array<double, 2> {
    return {0.1 * X + 0.05 * Y, -0.07 * Y + 0.02 * X};
  }));
  Matrix3 F = Matrix3::Identity();
  F.topLeftCorner<2, 2>() << 1.1, 0.05, 0.02, 0.93;
  const Matrix3 P = Hencky(ElasticConstants{1000.0, 0.3}).stress(F) * F.inverse().transpose();
  Eigen::VectorXd out_of_balance = internal_force(*bodies, u);
  const double scale = out_of_balance.cwiseAbs().maxCoeff();
  const std::vector<std::pair<std::string, Eigen::Vector3d>> sides{
      {"body/right", {1, 0, 0}}, {"body/left", {-1, 0, 0}}, {"body/top", {0, 1, 0}}, {"body/bottom", {0, -1, 0}}};
  for (const auto& [set, N] : sides) {
    const Eigen::Vector3d T = P * N;
    DeadTractionOptions options;
    options.set.value = set;
    options.x = T(0);
    options.y = T(1);
    out_of_balance -= force(*bodies, *options.make(bodies), u);
  }
  EXPECT_LE(out_of_balance.cwiseAbs().maxCoeff(), 1e-12 * scale);
}

TEST(SurfaceForce, IsATractionOfTheForceOverTheArea) {
  for (const auto& [name, kinematics] : kinematics_names()) {
    if (dimension(kinematics) == 3) continue;
    const auto bodies = bodies_of(kinematics);
    SurfaceForceOptions options;
    options.set.value = "body/top";
    options.x = parse_expression("3*t", {});
    options.y = -5.0;
    const Eigen::VectorXd f = force(*bodies, *options.make(bodies), bent(*bodies), 2.0);
    DeadTractionOptions traction;
    traction.set.value = "body/top";
    const double area = kinematics == Kinematics::axisymmetric ? EIGEN_PI * (9.0 - 4.0) : 0.7;  // on y = 1 between x = 2 and 3
    traction.x = 6.0 / area;
    traction.y = -5.0 / area;
    EXPECT_LE((f - force(*bodies, *traction.make(bodies), bent(*bodies), 2.0)).cwiseAbs().maxCoeff(), 1e-13) << name;
    EXPECT_NEAR(sum(f, 0), 6.0, 1e-13) << name;
    EXPECT_NEAR(sum(f, 1), -5.0, 1e-13) << name;
  }
}

TEST(FollowerPressure, PushesAgainstTheOutwardNormal) {
  const auto bodies = bodies_of(Kinematics::plane_strain);
  FollowerPressureOptions options;
  options.set.value = "body/right";
  options.pressure = 4.0;
  const Eigen::VectorXd f = force(*bodies, *options.make(bodies), Eigen::VectorXd::Zero(local_id_count(*bodies->space().local_dofs())));
  EXPECT_NEAR(sum(f, 0), -4.0 * 0.7, 1e-13);
  EXPECT_NEAR(sum(f, 1), 0.0, 1e-13);
}

TEST(FollowerPressure, OnTheWholeSurfaceHasNoResultantInThePlane) {
  const auto bodies = bodies_of(Kinematics::plane_strain);
  FollowerPressureOptions options;
  options.set.value = "body/surface";
  options.pressure = 4.0;
  const Eigen::VectorXd f = force(*bodies, *options.make(bodies), bent(*bodies));
  EXPECT_NEAR(sum(f, 0), 0.0, 1e-13 * 4.0);
  EXPECT_NEAR(sum(f, 1), 0.0, 1e-13 * 4.0);
}

TEST(FollowerPressure, AxisymmetricIsTheDerivativeOfPressureTimesVolume) {
  // Work of uniform pressure on a closed surface: -p dV, V the volume of the deformed ring.
  const auto bodies = bodies_of(Kinematics::axisymmetric);
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
  EXPECT_LE((f + 4.0 * central_differences(volume, u, 1e-5).row(0).transpose()).cwiseAbs().maxCoeff(), 1e-6 * f.cwiseAbs().maxCoeff());
}

TEST(FollowerPressure, JacobianIsTheDerivativeOfItsForce) {
  for (const auto& [name, kinematics] : kinematics_names())
    for (const char* set : {"body/surface", "body/right"}) {
      if (dimension(kinematics) == 3) continue;
      const auto bodies = bodies_of(kinematics);
      FollowerPressureOptions options;
      options.set.value = set;
      options.pressure = parse_expression("t*(1+x*y)", {});
      const auto load = options.make(bodies);
      ASSERT_TRUE(load->follows());
      const Eigen::VectorXd u = bent(*bodies);
      Matrix matrix(bodies->space().graph());
      std::optional<StepFailure> failure;
      load->add_jacobian(2.0, to_local(*bodies, u), matrix, failure);
      ASSERT_FALSE(failure);
      const Eigen::MatrixXd K = to_dense(matrix);
      const auto minus_force = [&](const Eigen::VectorXd& v) { return Eigen::VectorXd(-force(*bodies, *load, v, 2.0)); };
      EXPECT_LE((K - central_differences(minus_force, u)).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff()) << name << " " << set;
    }
}

TEST(Gravity, HasTheWeightOfTheBody) {
  for (const auto& [name, kinematics] : kinematics_names()) {
    if (dimension(kinematics) == 3) continue;
    const auto bodies = bodies_of(kinematics);
    GravityOptions options;
    options.y = parse_expression("-9.81*t", {});
    const Eigen::VectorXd f = force(*bodies, *options.make(bodies), bent(*bodies), 0.5);
    const double volume = kinematics == Kinematics::axisymmetric ? EIGEN_PI * (9.0 - 4.0) : 0.7;
    EXPECT_NEAR(sum(f, 1), -0.5 * 9.81 * 2.0 * volume, 1e-12 * volume * 10.0) << name;
    EXPECT_EQ(sum(f, 0), 0.0);
  }
}

// Plane: omega^2 m (x - c) of the centre of mass. Axisymmetric: omega^2 rho times the integral of r 2 pi r dr along r.
TEST(Centrifugal, HasTheForceOfItsIntegral) {
  for (const auto& [name, kinematics] : kinematics_names()) {
    if (dimension(kinematics) == 3) continue;
    const auto bodies = bodies_of(kinematics);
    const bool axisymmetric = kinematics == Kinematics::axisymmetric;
    CentrifugalOptions options;
    options.speed = parse_expression("3*t", {});
    if (!axisymmetric) options.point = {1.0, 0.25};
    const auto load = options.make(bodies);
    const Eigen::VectorXd f = force(*bodies, *load, Eigen::VectorXd::Zero(local_id_count(*bodies->space().local_dofs())), 0.5);
    const double x = axisymmetric ? 2.25 * 2.0 * 2.0 * EIGEN_PI * (27.0 - 8.0) / 3.0 : 2.25 * 2.0 * 0.7 * 1.5;
    EXPECT_NEAR(sum(f, 0), x, 1e-12 * x) << name;
    EXPECT_NEAR(sum(f, 1), axisymmetric ? 0.0 : 2.25 * 2.0 * 0.7 * 0.25, 1e-12 * x) << name;
    const Eigen::VectorXd u = bent(*bodies);
    Matrix matrix(bodies->space().graph());
    std::optional<StepFailure> failure;
    load->add_jacobian(2.0, to_local(*bodies, u), matrix, failure);
    const auto minus_force = [&](const Eigen::VectorXd& v) { return Eigen::VectorXd(-force(*bodies, *load, v, 2.0)); };
    const Eigen::MatrixXd K = to_dense(matrix);
    EXPECT_LE((K - central_differences(minus_force, u)).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff()) << name;
  }
}

TEST(Loads, SayWhichSetOrBodyIsMissing) {
  const auto bodies = bodies_of(Kinematics::plane_strain);
  DeadTractionOptions traction;
  traction.set = {"body/tpo", {"scene.xml", 7, "loads/wind"}};
  GravityOptions gravity;
  gravity.body = {"bdy", {"scene.xml", 9, "loads/weight"}};
  const auto message = [&](const LoadOptions& options) -> std::string {
    try {
      options.make(bodies);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(traction).find("scene.xml:7"), std::string::npos);
  EXPECT_NE(message(traction).find("body/top"), std::string::npos);
  EXPECT_NE(message(gravity).find("scene.xml:9"), std::string::npos);
  EXPECT_NE(message(gravity).find("bdy"), std::string::npos);
}

TEST(Loads, ReportAnExpressionWithoutAValueAsFailure) {
  const auto bodies = bodies_of(Kinematics::plane_strain);
  NodalForceOptions options;
  options.set.value = "body/top";
  options.x = parse_expression("1/(t-1)", {});
  Vector residual(bodies->space().dofs());
  std::optional<StepFailure> failure;
  options.make(bodies)->add_residual(1.0, Vector(bodies->space().local_dofs()), residual, failure);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind(), FailureKind::input);
}

TEST(Loads, AreRegistered) {
  std::vector<std::string> names;
  for (const auto& entry : load_registry().entries()) names.push_back(entry.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"nodal force", "surface force", "moment", "dead traction", "follower pressure", "gravity", "centrifugal"}));
}

}  // namespace
}  // namespace mortise
