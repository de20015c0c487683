// Every allowed element x law x kinematics: the stiffness is the derivative of the internal force, which is that of the stored energy.

#include <gtest/gtest.h>

#include "mortise/material/plane_stress.hpp"
#include "solid_test_support.hpp"

namespace mortise {
namespace {

struct Displacement {
  std::string name;
  Field field;
};

/// Turned by `angle` about the middle of the body, after a stretch and a smooth disturbance.
Field turned(double angle, double stretch_x, double stretch_y, double disturbance) {
  return [=](double X, double Y) -> std::array<double, 2> {
    const double x = stretch_x * (X - 2.5) + disturbance * std::sin(2.0 * X + Y), y = stretch_y * (Y - 0.5) + disturbance * std::cos(X - 3.0 * Y);
    return {2.5 + std::cos(angle) * x - std::sin(angle) * y - X, 0.5 + std::sin(angle) * x + std::cos(angle) * y - Y};
  };
}

std::vector<Displacement> displacements() {
  return {{"none", turned(0.0, 1.0, 1.0, 0.0)},
          {"small", turned(0.0, 1.0, 1.0, 1e-4)},
          {"large", turned(0.0, 1.2, 0.85, 0.06)},  // more leaves St Venant-Kirchhoff no thickness in plane stress
          {"turned by 2.5 rad", turned(2.5, 1.1, 0.95, 0.06)},
          {"equal stretches", turned(0.7, 1.1, 1.1, 0.0)},
          {"nearly equal stretches", turned(0.7, 1.1, 1.1 + 1e-9, 0.0)}};
}

std::vector<BodySetup> allowed_setups() {
  std::vector<BodySetup> setups;
  for (const auto& [element_name, element] : element_names())
    for (const auto& material : material_registry().entries())
      for (const auto& [kinematics_name, kinematics] : kinematics_names()) {
        if (dimension(kinematics) == 3) continue;
        if (!check_combination({"body", {}, make_material(material.name), element}, kinematics).empty()) continue;
        BodySetup setup;
        setup.element = element;
        setup.law = material.name;
        setup.kinematics = kinematics;
        setups.push_back(setup);
      }
  return setups;
}

bool has_history(const std::string& law) {
  return std::visit([](const auto& any) { return mortise::has_history<std::decay_t<decltype(any)>>; }, make_material(law)->law());
}

std::vector<BodySetup> setups_with_history() {
  std::vector<BodySetup> setups;
  for (const BodySetup& setup : allowed_setups())
    if (has_history(setup.law)) setups.push_back(setup);
  return setups;
}

/// F-bar's force derives from no energy, nor does that of a body that flows.
std::vector<BodySetup> standard_setups() {
  std::vector<BodySetup> setups;
  for (const BodySetup& setup : allowed_setups())
    if (formulation(setup.element) == ElementFormulation::standard && !has_history(setup.law)) setups.push_back(setup);
  return setups;
}

std::string setup_name(const testing::TestParamInfo<BodySetup>& info) {
  std::string name = to_string(info.param.element) + "_" + info.param.law + "_" + to_string(info.param.kinematics);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

class EverySetup : public testing::TestWithParam<BodySetup> {};
class EveryStandardSetup : public EverySetup {};
class EverySetupWithHistory : public EverySetup {};

INSTANTIATE_TEST_SUITE_P(Tangent, EverySetup, testing::ValuesIn(allowed_setups()), setup_name);
INSTANTIATE_TEST_SUITE_P(Tangent, EveryStandardSetup, testing::ValuesIn(standard_setups()), setup_name);
INSTANTIATE_TEST_SUITE_P(Tangent, EverySetupWithHistory, testing::ValuesIn(setups_with_history()), setup_name);

TEST(Combinations, AreSeventeenOfAStandardElementAndTenOfFBar) {
  // Standard: 6 laws in plane strain and axisymmetric, the 5 without a history in plane stress; F-bar: 5 laws in plane strain and axisymmetric.
  std::size_t combinations = 0;
  for (const ElementType element : elements_of(2)) combinations += formulation(element) == ElementFormulation::standard ? 6 + 6 + 5 : 5 + 5;
  EXPECT_EQ(allowed_setups().size(), combinations);
}

TEST_P(EverySetup, StiffnessIsTheDerivativeOfTheForce) {
  for (double nu : {0.0, 0.3, 0.49}) {
    BodySetup setup = GetParam();
    setup.poissons_ratio = nu;
    const auto bodies = make_test_bodies(self(), setup);
    for (const Displacement& displacement : displacements()) {
      const Eigen::VectorXd u = to_eigen(local_field(*bodies, displacement.field));
      const Eigen::MatrixXd K = stiffness(*bodies, u);
      const Eigen::MatrixXd difference = central_differences([&](const Eigen::VectorXd& v) { return internal_force(*bodies, v); }, u);
      EXPECT_LE((K - difference).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff()) << displacement.name << ", nu " << nu;
    }
  }
}

double largest_plastic_strain(const Bodies& bodies, const Eigen::VectorXd& u) {
  double largest = 0.0;
  bodies.visit_points(to_local(bodies, u), [&](const MaterialPoint& point) { largest = std::max(largest, point.equivalent_plastic_strain); });
  return largest;
}

TEST_P(EverySetupWithHistory, StiffnessIsTheDerivativeOfTheForceAfterFlow) {
  for (double nu : {0.0, 0.3, 0.49}) {
    BodySetup setup = GetParam();
    setup.poissons_ratio = nu;
    const auto bodies = make_test_bodies(self(), setup);
    const auto field = [&](const Field& f) { return to_eigen(local_field(*bodies, f)); };
    bodies->commit(local_field(*bodies, turned(0.3, 1.15, 0.9, 0.05)));
    const double committed = largest_plastic_strain(*bodies, field(turned(0.3, 1.15, 0.9, 0.05)));
    ASSERT_GT(committed, 0.05);
    struct Case {
      std::string name;
      Field field;
      bool flows;
    };
    // The disturbance is that of the committed state, so that what is unloaded is so at every point.
    const std::vector<Case> cases{{"further", turned(0.5, 1.25, 0.82, 0.05), true},
                                  {"back by less than the yield strain", turned(0.3, 1.142, 0.903, 0.05), false},
                                  {"turned, unloaded", turned(2.0, 1.142, 0.903, 0.05), false},
                                  {"reversed", turned(0.3, 0.95, 1.1, 0.05), true}};
    for (const Case& at : cases) {
      if (setup.kinematics == Kinematics::axisymmetric && at.name == "turned, unloaded") continue;  // no rigid motion there
      const Eigen::VectorXd u = field(at.field);
      if (at.flows)
        EXPECT_GT(largest_plastic_strain(*bodies, u), committed + 0.01) << at.name;
      else
        EXPECT_EQ(largest_plastic_strain(*bodies, u), committed) << at.name;
      const Eigen::MatrixXd K = stiffness(*bodies, u);
      const Eigen::MatrixXd difference = central_differences([&](const Eigen::VectorXd& v) { return internal_force(*bodies, v); }, u);
      EXPECT_LE((K - difference).cwiseAbs().maxCoeff(), 1e-6 * K.cwiseAbs().maxCoeff()) << at.name << ", nu " << nu;
    }
  }
}

TEST_P(EverySetupWithHistory, CommitEndsTheStepAndOnlyCommitDoes) {
  const auto bodies = make_test_bodies(self(), GetParam());
  const Eigen::VectorXd flowed = to_eigen(local_field(*bodies, turned(0.3, 1.15, 0.9, 0.05))), none = Eigen::VectorXd::Zero(flowed.size());
  const Eigen::VectorXd before = internal_force(*bodies, flowed);
  EXPECT_EQ(internal_force(*bodies, none).cwiseAbs().maxCoeff(), 0.0);  // asking for flow has left nothing behind
  bodies->commit(to_local(*bodies, flowed));
  const double scale = before.cwiseAbs().maxCoeff();
  EXPECT_LE((internal_force(*bodies, flowed) - before).cwiseAbs().maxCoeff(), 1e-11 * scale);
  EXPECT_GT(internal_force(*bodies, none).cwiseAbs().maxCoeff(), 1e-6 * scale);  // residual stresses, far above round-off
  bodies->commit(to_local(*bodies, flowed));
  EXPECT_LE((internal_force(*bodies, flowed) - before).cwiseAbs().maxCoeff(), 1e-11 * scale);
}

TEST_P(EveryStandardSetup, ForceIsTheDerivativeOfTheEnergy) {
  const auto bodies = make_test_bodies(self(), GetParam());
  const Eigen::VectorXd u = to_eigen(local_field(*bodies, turned(0.3, 1.2, 0.85, 0.08)));
  const auto energy = [&](const Eigen::VectorXd& v) { return Eigen::VectorXd::Constant(1, bodies->stored_energies(to_local(*bodies, v))[0]); };
  const Eigen::VectorXd force = internal_force(*bodies, u);
  EXPECT_LE((central_differences(energy, u, 1e-5).row(0).transpose() - force).cwiseAbs().maxCoeff(), 1e-6 * force.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd K = stiffness(*bodies, u);
  EXPECT_LE((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
}

TEST_P(EverySetup, RigidMotionTakesNoForce) {
  const BodySetup& setup = GetParam();
  const auto bodies = make_test_bodies(self(), setup);
  const bool axisymmetric = setup.kinematics == Kinematics::axisymmetric;
  const double angle = axisymmetric || setup.law == "small strain linear" ? 0.0 : 2.0;
  const Field rigid = [&](double X, double Y) -> std::array<double, 2> {
    return {std::cos(angle) * X - std::sin(angle) * Y - X + (axisymmetric ? 0.0 : 3.0), std::sin(angle) * X + std::cos(angle) * Y - Y - 2.0};
  };
  const Eigen::VectorXd u = to_eigen(local_field(*bodies, rigid));
  const Eigen::MatrixXd K = stiffness(*bodies, u);
  const double round_off = 1e-13 * K.cwiseAbs().maxCoeff() * u.cwiseAbs().maxCoeff();
  EXPECT_LE(internal_force(*bodies, u).cwiseAbs().maxCoeff(), round_off);
  // The rigid body modes are exactly the null space there.
  const auto modes = rigid_body_modes(*bodies, to_local(*bodies, u));
  ASSERT_EQ(modes->getNumVectors(), axisymmetric ? 1u : 3u);
  for (std::size_t n = 0; n < modes->getNumVectors(); ++n)
    if (setup.law != "small strain linear" || n < 2) {
      EXPECT_LE((K * to_eigen(*modes->getVector(n))).cwiseAbs().maxCoeff(), 1e-11 * K.cwiseAbs().maxCoeff());
    }
  const Eigen::VectorXd singular = K.jacobiSvd().singularValues();
  EXPECT_EQ((singular.array() < 1e-9 * singular(0)).count(), axisymmetric ? 1 : 3);
}

TEST_P(EverySetup, HomogeneousDeformationOfADistortedMeshIsExact) {
  BodySetup setup = GetParam();
  setup.cells_x = setup.cells_y = 4;
  const auto bodies = make_test_bodies(self(), setup);
  const Mesh& mesh = *bodies->mesh();
  const bool axisymmetric = setup.kinematics == Kinematics::axisymmetric;
  // F constant: any in 2D; u_r = a R and u_z = b Z if axisymmetric.
  Eigen::Matrix2d gradient;
  gradient << 0.1, (axisymmetric ? 0.0 : 0.06), (axisymmetric ? 0.0 : -0.04), -0.08;
  const Field field = [&](double X, double Y) -> std::array<double, 2> {
    return {gradient(0, 0) * X + gradient(0, 1) * Y, gradient(1, 0) * X + gradient(1, 1) * Y};
  };
  const Vector u = local_field(*bodies, field);
  const Eigen::VectorXd force = internal_force(*bodies, to_eigen(u));
  const double scale = force.cwiseAbs().maxCoeff();
  for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
    const auto& X = mesh.coordinates[node];
    const bool inside = X[0] > 2.0 + 1e-9 && X[0] < 3.0 - 1e-9 && X[1] > 1e-9 && X[1] < 1.0 - 1e-9;
    if (inside) {
      EXPECT_LE(force.segment<2>(2 * node).cwiseAbs().maxCoeff(), 1e-12 * scale);
    }
  }
  // Every point sees this F and the law's stress of it.
  Matrix3 F = Matrix3::Identity();
  F.topLeftCorner<2, 2>() += gradient;
  if (axisymmetric) F(2, 2) += gradient(0, 0);
  double volume = 0.0, current_volume = 0.0;
  std::visit(
      [&](const auto& law) {
        if constexpr (std::decay_t<decltype(law)>::plane_stress)
          if (setup.kinematics == Kinematics::plane_stress) F = law.with_plane_stress(F);
        const Matrix3 cauchy = Unconstrained<std::decay_t<decltype(law)>>{law}.stress(F, {}) / (law.small_strain ? 1.0 : F.determinant());
        bodies->visit_points(u, [&](const MaterialPoint& point) {
          EXPECT_LE((point.deformation_gradient - F).norm(), 1e-13);
          EXPECT_LE((point.cauchy_stress - cauchy).norm(), 1e-12 * 1000.0);
          const auto moved = field(point.reference_position[0], point.reference_position[1]);
          EXPECT_NEAR(point.position[0], point.reference_position[0] + moved[0], 1e-13);
          EXPECT_NEAR(point.position[1], point.reference_position[1] + moved[1], 1e-13);
          volume += point.weight;
          current_volume += point.weight * point.volume_ratio;
        });
        const auto nodal = bodies->nodal_stresses(u);
        const auto view = nodal->getLocalViewHost(Tpetra::Access::ReadOnly);
        const auto elements = bodies->element_stresses(u, 0);
        const Matrix3 strain = expected_strain(F, law.small_strain);
        const auto nodal_strains = bodies->nodal_strains(u);
        const auto strain_view = nodal_strains->getLocalViewHost(Tpetra::Access::ReadOnly);
        const auto element_strains = bodies->element_strains(u, 0);
        for (int c = 0; c < 4; ++c) {
          const double expected = c < 3 ? cauchy(c, c) : cauchy(0, 1), expected_strain = c < 3 ? strain(c, c) : strain(0, 1);
          for (LocalOrdinal node = 0; node < mesh.owned_count(); ++node) {
            EXPECT_NEAR(view(node, c), expected, 1e-12 * 1000.0);
            EXPECT_NEAR(strain_view(node, c), expected_strain, 1e-12);
          }
          for (const auto& stress : elements) EXPECT_NEAR(stress[c], expected, 1e-12 * 1000.0);
          for (const auto& strain_of_element : element_strains) EXPECT_NEAR(strain_of_element[c], expected_strain, 1e-12);
        }
      },
      make_material(setup.law)->law());
  // The ring between radii 2 and 3 of height 1, or the unit square times the thickness.
  const double exact_volume = axisymmetric ? EIGEN_PI * (9.0 - 4.0) : 0.7;
  EXPECT_NEAR(volume, exact_volume, 1e-13 * exact_volume);
  if (setup.law != "small strain linear") {
    EXPECT_NEAR(current_volume, exact_volume * F.determinant(), 1e-12 * exact_volume);
  }
}

}  // namespace
}  // namespace mortise
