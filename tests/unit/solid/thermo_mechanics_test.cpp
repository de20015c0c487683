// Bodies whose law knows the temperature: all blocks of the Jacobian against differences, exact stresses, heat, memory, messages.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stored_numbers.hpp"
#include "thermal_test_support.hpp"

namespace mortise {
namespace {

std::vector<ThermalSetup> every_setup() {
  std::vector<ThermalSetup> setups;
  for (const auto& [element_name, element] : element_names())
    for (const auto& [kinematics_name, kinematics] : kinematics_names())
      for (const auto& material : material_registry().entries()) {
        if (!check_combination({"body", {}, make_material(material.name), element}, kinematics).empty()) continue;
        for (const double heat_at_start : {0.0, 0.5}) setups.push_back({element, material.name, kinematics, true, heat_at_start});
        if (material.name == "hencky") setups.push_back({element, material.name, kinematics, false});
      }
  return setups;
}

std::string setup_name(const testing::TestParamInfo<ThermalSetup>& info) {
  std::string name = to_string(info.param.element) + "_" + info.param.law + "_" + to_string(info.param.kinematics);
  if (!info.param.everything) name += "_expansion";
  if (info.param.heat_at_start > 0.0) name += "_trapezoidal";
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

class EveryThermalSetup : public testing::TestWithParam<ThermalSetup> {};
INSTANTIATE_TEST_SUITE_P(ThermoMechanics, EveryThermalSetup, testing::ValuesIn(every_setup()), setup_name);

/// Central differences of fourth order, with a step for each field: displacements are of size 1, temperatures vary over some 1000.
Eigen::MatrixXd differences(const Bodies& bodies, const Eigen::VectorXd& x, Eigen::Index displacements) {
  Eigen::MatrixXd J(x.size(), x.size());
  for (Eigen::Index n = 0; n < x.size(); ++n) {
    const double step = n < displacements ? 1e-5 : 1.0;
    const auto at = [&](double by) {
      Eigen::VectorXd moved = x;
      moved(n) += by;
      return thermal_residual(bodies, moved);
    };
    J.col(n) = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
  }
  return J;
}

TEST_P(EveryThermalSetup, EveryBlockOfTheJacobianIsADerivative) {
  const auto bodies = make_thermal_bodies(GetParam());
  EXPECT_TRUE(bodies->know_temperature());
  const bool heats = GetParam().everything || GetParam().law == FiniteJ2::name;
  EXPECT_EQ(bodies->heat(), heats);
  bodies->commit(thermal_state(*bodies, stretched(0.6), warm(320.0)));
  const Eigen::VectorXd x = to_eigen(thermal_state(*bodies, stretched(1.0), warm(350.0)));
  const Eigen::Index all = x.size(), temperatures = bodies->mesh()->owned_count(), displacements = all - temperatures;
  Matrix matrix(bodies->space().graph());
  std::optional<StepFailure> failure;
  bodies->add_stiffness(to_local(*bodies, x), matrix, failure, 1.0, step_length);
  ASSERT_FALSE(failure) << failure->what();
  const Eigen::MatrixXd J = to_dense(matrix), expected = differences(*bodies, x, displacements);
  const auto compare = [&](Eigen::Index row, Eigen::Index rows, Eigen::Index column, Eigen::Index columns, const char* name) {
    const double size = J.block(row, column, rows, columns).cwiseAbs().maxCoeff();
    EXPECT_LE((J - expected).block(row, column, rows, columns).cwiseAbs().maxCoeff(), 1e-6 * size) << name;
    EXPECT_EQ(size > 0.0, row == 0 || heats) << name;
  };
  compare(0, displacements, 0, displacements, "forces by displacements");
  compare(0, displacements, displacements, temperatures, "forces by temperatures");
  compare(displacements, temperatures, 0, displacements, "heat by displacements");
  compare(displacements, temperatures, displacements, temperatures, "heat by temperatures");

  // One pass for both gives the same.
  Vector residual(bodies->space().dofs());
  Matrix again(bodies->space().graph());
  bodies->add_internal_force_and_stiffness(to_local(*bodies, x), residual, again, failure, 1.0, step_length);
  EXPECT_EQ(to_dense(again), J);
  const Eigen::VectorXd alone = thermal_residual(*bodies, x);
  EXPECT_LE((to_eigen(residual) - alone).head(displacements).cwiseAbs().maxCoeff(), 1e-13 * alone.head(displacements).cwiseAbs().maxCoeff());
  if (heats) EXPECT_LE((to_eigen(residual) - alone).tail(temperatures).cwiseAbs().maxCoeff(), 1e-11 * alone.tail(temperatures).cwiseAbs().maxCoeff());

  // The rows of the temperature hold the power that heats, as sum of N_a = 1.
  const double power = bodies->heat_powers(to_local(*bodies, x), step_length)[0];
  EXPECT_NEAR(alone.tail(temperatures).sum(), -power, 1e-12 * (1.0 + alone.tail(temperatures).cwiseAbs().sum()));
}

TEST_P(EveryThermalSetup, IsThePlainBodyAtTheReferenceTemperatureWithConstantProperties) {
  ThermalSetup setup = GetParam();
  setup.everything = false;
  const auto thermal = make_thermal_bodies(setup);
  const auto plain = std::make_shared<Bodies>(thermal->shared_space(), setup.kinematics, 0.7,
                                              std::vector<BodyProperties>{{"body", {}, make_material(setup.law), setup.element}});
  EXPECT_FALSE(plain->know_temperature());
  const Vector x = thermal_state(*thermal, stretched(1.0), at_reference);
  const Eigen::VectorXd expected = thermal_residual(*plain, to_eigen(x)), force = thermal_residual(*thermal, to_eigen(x), Bodies::without_rates);
  EXPECT_LE((force - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.cwiseAbs().maxCoeff());
  std::vector<MaterialPoint> points;
  plain->visit_points(x, [&](const MaterialPoint& point) { points.push_back(point); });
  std::size_t n = 0;
  thermal->visit_points(x, [&](const MaterialPoint& point) {
    const MaterialPoint& other = points.at(n++);
    EXPECT_LE((point.cauchy_stress - other.cauchy_stress).norm(), 1e-15 * other.cauchy_stress.norm());
    EXPECT_LE((point.deformation_gradient - other.deformation_gradient).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(point.volume_ratio, other.volume_ratio);
    EXPECT_DOUBLE_EQ(point.energy, other.energy);
    EXPECT_EQ(point.equivalent_plastic_strain, other.equivalent_plastic_strain);
    EXPECT_EQ(point.plastic_work, other.plastic_work);
    EXPECT_EQ(point.position, other.position);
    EXPECT_EQ(point.weight, other.weight);
  });
  EXPECT_EQ(n, points.size());
  thermal->commit(x);
  plain->commit(x);
  const Vector further = thermal_state(*thermal, stretched(0.7), at_reference);
  const Eigen::VectorXd after = thermal_residual(*plain, to_eigen(further));
  EXPECT_LE((thermal_residual(*thermal, to_eigen(further), Bodies::without_rates) - after).cwiseAbs().maxCoeff(),
            1e-14 * after.cwiseAbs().maxCoeff());
}

// The stretch exp(alpha (theta - theta_0)) in all directions, small strain 1 + alpha (theta - theta_0), leaves no stress.
TEST_P(EveryThermalSetup, FreeExpansionTakesNoForce) {
  if (GetParam().kinematics == Kinematics::plane_strain) return;  // nothing is free across the plane
  const auto bodies = make_thermal_bodies(GetParam());
  const double temperature = 380.0,
               strain = bodies->properties()[0].material->thermal.expansion.at(temperature) * (temperature - reference_temperature);
  const double stretch = GetParam().law == SmallStrainLinear::name ? 1.0 + strain : std::exp(strain);
  const Vector x = thermal_state(
      *bodies,
      [&](const Point3& X) -> Point3 {
        return {(stretch - 1.0) * X[0], (stretch - 1.0) * X[1], (stretch - 1.0) * X[2]};
      },
      [&](const Point3&) { return temperature; });
  bodies->visit_points(x, [&](const MaterialPoint& point) {
    EXPECT_LE(point.cauchy_stress.norm(), 1e-12 * 1000.0);
    EXPECT_NEAR(point.deformation_gradient(2, 2), stretch, 1e-12);
  });
  EXPECT_LE(thermal_residual(*bodies, to_eigen(x), Bodies::without_rates).cwiseAbs().maxCoeff(), 1e-12 * 1000.0);
}

TEST_P(EveryThermalSetup, IsRestoredAsItWasStored) {
  const auto bodies = make_thermal_bodies(GetParam()), restored = make_thermal_bodies(GetParam());
  bodies->commit(thermal_state(*bodies, stretched(0.6), warm(320.0)));
  test::StoredNumbers stored;
  bodies->serialize(stored);
  test::StoredNumbers full(stored.numbers);
  restored->serialize(full);
  const Eigen::VectorXd x = to_eigen(thermal_state(*bodies, stretched(1.0), warm(350.0)));
  EXPECT_EQ(thermal_residual(*restored, x), thermal_residual(*bodies, x));
  EXPECT_EQ(restored->history_bytes(0), bodies->history_bytes(0));
}

// A temperature that varies in F-bar elements without displacement: the thermal strain is that of the centre, so that each element has one pressure.
TEST(FBar, ConfinedHeatingGivesOnePressureInAnElement) {
  for (const auto& [element, kinematics] :
       {std::pair(ElementType::q4_f_bar, Kinematics::plane_strain), std::pair(ElementType::q4_f_bar, Kinematics::axisymmetric),
        std::pair(ElementType::h8_f_bar, Kinematics::three_dimensional)}) {
    const auto bodies = make_thermal_bodies({element, "hencky", kinematics, false});
    const Vector x = thermal_state(*bodies, at_rest, warm(350.0));
    const double K = ElasticConstants{1000.0, 0.3}.bulk_modulus();
    std::vector<double> centres(bodies->mesh()->blocks[0].size());
    for (std::size_t e = 0; e < centres.size(); ++e) {
      const Block& block = bodies->mesh()->blocks[0];
      const LocalOrdinal* nodes = block.nodes(static_cast<LocalOrdinal>(e));
      for (int a = 0; a < block.nodes_per_element; ++a) centres[e] += warm(350.0)(bodies->mesh()->coordinates[nodes[a]]) / block.nodes_per_element;
    }
    bodies->visit_points(x, [&](const MaterialPoint& point) {
      const Matrix3 expected = -3.0 * K * 2e-4 * (centres[point.element] - reference_temperature) * Matrix3::Identity();
      EXPECT_LE((point.cauchy_stress - expected).norm(), 1e-13 * 1000.0);
    });
  }
}

// Of a body that flows, chi sigma_y Delta alpha / Delta t summed over the points.
TEST(PlasticHeat, IsTheShareOfThePlasticPower) {
  const auto bodies = make_thermal_bodies({ElementType::q4, FiniteJ2::name, Kinematics::plane_strain, false});
  bodies->commit(thermal_state(*bodies, stretched(0.6), at_reference));
  std::vector<double> before;
  bodies->visit_points(thermal_state(*bodies, stretched(0.6), at_reference),
                       [&](const MaterialPoint& point) { before.push_back(point.equivalent_plastic_strain); });
  const Vector x = thermal_state(*bodies, stretched(1.0), at_reference);
  const SwiftHardening hardening{20.0, 0.02, 0.3};
  double expected = 0.0;
  std::size_t n = 0;
  bodies->visit_points(x, [&](const MaterialPoint& point) {
    const double alpha = point.equivalent_plastic_strain;
    expected +=
        point.weight * ThermomechanicalProperties::usual_plastic_heat_share * hardening.yield_stress(alpha) * (alpha - before[n++]) / step_length;
  });
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(bodies->heat_powers(x, step_length)[0], expected, 1e-12 * expected);
  EXPECT_EQ(bodies->heat_powers(x, Bodies::without_rates)[0], 0.0);
}

// Half of the heat is that of a step at the temperatures of its start, as long as nothing flows.
TEST(ThermoelasticHeat, HasTheShareOfTheTemperaturesOfTheStart) {
  for (const auto& [element, kinematics] :
       {std::pair(ElementType::q8, Kinematics::plane_strain), std::pair(ElementType::q4_f_bar, Kinematics::axisymmetric),
        std::pair(ElementType::h8_f_bar, Kinematics::three_dimensional)}) {
    const auto heat = [&, element = element, kinematics = kinematics](double share, const Temperature& before, const Temperature& after) {
      const auto bodies = make_thermal_bodies({element, "hencky", kinematics, true, share});
      bodies->begin(thermal_state(*bodies, at_rest, before));
      return bodies->heat_powers(thermal_state(*bodies, stretched(1.0), after), step_length)[0];
    };
    const double cold = heat(0.0, warm(310.0), warm(310.0)), hot = heat(0.0, warm(350.0), warm(350.0));
    EXPECT_GT(std::abs(hot - cold), 0.01 * std::abs(hot));
    EXPECT_NEAR(heat(0.5, warm(310.0), warm(350.0)), 0.5 * (cold + hot), 1e-12 * std::abs(hot));
  }
}

TEST(ThermalBodies, KnowNoTemperatureWithoutTheField) {
  const ThermalSetup setup;
  const RCP<const Mesh> mesh = make_thermal_mesh(self(), setup);
  const Bodies without(displacement_space(mesh), setup.kinematics, 0.7, {{"body", {}, make_thermal_material("hencky", true), ElementType::q4}});
  EXPECT_FALSE(without.know_temperature());
  EXPECT_FALSE(without.heat());
  // A field that lives on the first node alone.
  std::vector<char> lives(mesh->owned_count(), 0);
  lives[0] = 1;
  const auto space = std::make_shared<FieldSpace>(mesh, std::vector<FieldDeclaration>{{"displacement", 2}, {"temperature", 1, lives}});
  const Bodies partly(space, setup.kinematics, 0.7, {{"body", {}, make_thermal_material("hencky", true), ElementType::q4}});
  EXPECT_FALSE(partly.know_temperature());
}

TEST(ThermalBodies, SayWhereAPropertyHasNoMeaning) {
  const ThermalSetup setup;
  const auto material = std::const_pointer_cast<MaterialOptions>(make_thermal_material("hencky", false));
  material->thermal.youngs_modulus = TemperatureFunction({293.0, 393.0}, {1000.0, -1000.0});
  const Bodies bodies(thermal_space(make_thermal_mesh(self(), setup)), setup.kinematics, 0.7, {{"body", {}, material, ElementType::q4}});
  const auto failure_at = [&](const SpaceField& displacement, double temperature) {
    std::optional<StepFailure> failure;
    Vector residual(bodies.space().dofs());
    bodies.add_internal_force(thermal_state(bodies, displacement, [=](const Point3&) { return temperature; }), residual, failure);
    return failure;
  };
  EXPECT_FALSE(failure_at(at_rest, 300.0));
  const auto material_failure = failure_at(at_rest, 368.0);
  ASSERT_TRUE(material_failure);
  EXPECT_EQ(material_failure->kind(), FailureKind::material);
  EXPECT_THAT(material_failure->what(),
              testing::HasSubstr("body \"body\": the Young's modulus of the table is -500 at the temperature 368; it has to be "
                                 "finite and above 0 at point 0 of element 0 at ("));
  const auto inverted = failure_at([](const Point3& X) -> Point3 { return {-2.0 * X[0], 0.0, 0.0}; }, 300.0);
  ASSERT_TRUE(inverted);
  EXPECT_EQ(inverted->kind(), FailureKind::inverted_element);
}

}  // namespace
}  // namespace mortise
