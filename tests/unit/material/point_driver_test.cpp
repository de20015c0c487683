// One point along a path: uniaxial against closed forms, what stays zero, what fails.

#include "mortise/material/point_driver.hpp"

#include <gtest/gtest.h>

#include "law_fixture.hpp"
#include "mortise/input/read_parameters.hpp"
#include "plasticity_fixture.hpp"

namespace mortise {
namespace {

std::vector<PointRecord> drive(const Law& law, const PointPath& path) {
  std::vector<PointRecord> records;
  drive_point(law, points_of(path), [&](const PointRecord& record) { records.push_back(record); });
  return records;
}

template <class Path>
Path stretched_by(const std::string& stretch, int steps) {
  Path path;
  path.stretch = parse_expression(stretch, Symbols());
  path.steps = steps;
  return path;
}

std::vector<std::pair<std::string, Law>> every_law() {
  std::vector<std::pair<std::string, Law>> laws{{Hencky::name, Hencky(soft)},
                                                {NeoHooke::name, NeoHooke(soft)},
                                                {CiarletNeoHooke::name, CiarletNeoHooke(soft)},
                                                {StVenantKirchhoff::name, StVenantKirchhoff(soft)},
                                                {SmallStrainLinear::name, SmallStrainLinear(soft)}};
  for (const auto& [name, hardening] : every_hardening()) laws.emplace_back("j2 " + name, FiniteJ2(soft, hardening));
  return laws;
}

TEST(PointDriver, UniaxialPlasticityIsTheCurveOfTheHardeningLaw) {
  // |ln stretch| = tau / E + alpha and |tau| = sigma_y(alpha), in tension and compression, exact in steps of any size.
  for (const auto& [elastic, hardening] : {std::pair{steel, steel_hardening}, {aluminium, aluminium_hardening}})
    for (const double final_stretch : {1.5, 0.6})
      for (const int steps : {3, 200}) {
        UniaxialPath path;
        path.final_stretch = final_stretch;
        path.steps = steps;
        const auto records = drive(FiniteJ2(elastic, hardening), path);
        ASSERT_EQ(records.size(), steps + 1u);
        int plastic = 0;
        for (const PointRecord& record : records) {
          const double tau = std::abs(record.kirchhoff(0, 0)), alpha = record.equivalent_plastic_strain;
          EXPECT_NEAR(std::abs(std::log(record.F(0, 0))), tau / elastic.youngs_modulus + alpha, 1e-10);
          if (alpha > 0.0) EXPECT_NEAR(tau, hardening.yield_stress(alpha), 1e-10 * tau);
          if (alpha == 0.0) EXPECT_LE(tau, hardening.initial_yield_stress * (1.0 + 1e-11));
          plastic += alpha > 0.0;
        }
        EXPECT_GE(plastic, steps - 2);
      }
}

TEST(PointDriver, UniaxialElasticityIsTheClosedForm) {
  const double E = soft.youngs_modulus, nu = soft.poissons_ratio;
  for (const double final_stretch : {1.6, 0.7}) {
    UniaxialPath path;
    path.final_stretch = final_stretch;
    path.steps = 10;
    for (const PointRecord& record : drive(Hencky(soft), path)) {
      EXPECT_NEAR(record.kirchhoff(0, 0), E * std::log(record.F(0, 0)), 1e-10 * E);
      EXPECT_NEAR(record.F(1, 1), std::pow(record.F(0, 0), -nu), 1e-10);
    }
    for (const PointRecord& record : drive(NeoHooke(soft), path)) {
      const double stretch = record.F(0, 0);
      EXPECT_NEAR(record.kirchhoff(0, 0), soft.shear_modulus() * (stretch * stretch - std::pow(stretch, -2.0 * nu)), 1e-10 * E);
      EXPECT_NEAR(record.F(1, 1), std::pow(stretch, -nu), 1e-10);
    }
    for (const PointRecord& record : drive(SmallStrainLinear(soft), path)) {
      EXPECT_NEAR(record.cauchy(0, 0), E * (record.F(0, 0) - 1.0), 1e-10 * E);
      EXPECT_NEAR(record.F(2, 2) - 1.0, -nu * (record.F(0, 0) - 1.0), 1e-10);
    }
    for (const PointRecord& record : drive(StVenantKirchhoff(soft), path)) {
      const double green = 0.5 * (record.F(0, 0) * record.F(0, 0) - 1.0);
      EXPECT_NEAR(record.kirchhoff(0, 0), record.F(0, 0) * record.F(0, 0) * E * green, 1e-10 * E);
      EXPECT_NEAR(record.F(1, 1), std::sqrt(1.0 - 2.0 * nu * green), 1e-10);
    }
  }
}

TEST(PointDriver, LeavesNoStressWhereNoneIsWanted) {
  for (const auto& [name, law] : every_law())
    for (const int steps : {4, 57}) {
      for (const PointRecord& record : drive(law, stretched_by<UniaxialPath>("1 + 0.4*sin(2*pi*t)", steps))) {
        EXPECT_NEAR(record.kirchhoff(1, 1), 0.0, 1e-10 * 1000.0) << name;
        EXPECT_NEAR(record.kirchhoff(2, 2), 0.0, 1e-10 * 1000.0) << name;
        EXPECT_NEAR(record.F(1, 1), record.F(2, 2), 1e-10) << name;
        EXPECT_NEAR(record.von_mises(), std::abs(record.cauchy(0, 0)), 1e-9 * 1000.0) << name;
      }
      for (const PointRecord& record : drive(law, stretched_by<PlaneStrainPath>("1 + 0.4*sin(2*pi*t)", steps))) {
        EXPECT_NEAR(record.kirchhoff(1, 1), 0.0, 1e-10 * 1000.0) << name;
        EXPECT_EQ(record.F(2, 2), 1.0) << name;
      }
    }
}

TEST(PointDriver, SimpleShearIsSymmetric) {
  // Stresses are symmetric; shearing the other way turns the sign of the shear stress and of nothing else.
  SimpleShearPath there, back;
  there.shear = parse_expression("0.8*t", Symbols());
  back.shear = parse_expression("-0.8*t", Symbols());
  for (const auto& [name, law] : every_law()) {
    const auto one = drive(law, there), other = drive(law, back);
    for (std::size_t n = 0; n < one.size(); ++n) {
      const Matrix3 a = one[n].cauchy, b = other[n].cauchy, sign = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
      EXPECT_LE((a - a.transpose()).norm(), 1e-12 * 1000.0) << name;
      EXPECT_LE((sign * a * sign - b).norm(), 1e-11 * 1000.0) << name;
      EXPECT_NEAR(one[n].equivalent_plastic_strain, other[n].equivalent_plastic_strain, 1e-12) << name;
      EXPECT_EQ(a(0, 2), 0.0) << name;
    }
    EXPECT_GT(one.back().cauchy(0, 1), 1.0) << name;
  }
}

TEST(PointDriver, TakesAnyDeformationGradient) {
  DeformationGradientPath path;
  path.steps = 8;
  path.components[1] = parse_expression("0.5*t", Symbols());
  path.components[8] = parse_expression("1 - 0.2*t", Symbols());
  const auto records = drive(NeoHooke(soft), path);
  const Matrix3 F = (Matrix3() << 1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.8).finished();
  EXPECT_LE((records.back().F - F).norm(), 1e-15);
  EXPECT_LE((records.back().cauchy * F.determinant() - NeoHooke(soft).stress(F)).norm(), 1e-12 * 1000.0);
  EXPECT_EQ(records.back().equivalent_plastic_strain, 0.0);
  EXPECT_NEAR(records.back().strain.trace(), std::log(0.8), 1e-14);
}

TEST(PointDriver, NamesTheStepWithoutALateralStretch) {
  // St Venant-Kirchhoff: F_22^2 = 1 - nu (F_11^2 - 1) is negative beyond F_11 = sqrt(1 + 1 / nu) = 2.08.
  UniaxialPath path;
  path.final_stretch = 3.0;
  path.steps = 20;
  int steps = 0;
  try {
    drive_point(StVenantKirchhoff(soft), points_of(path), [&](const PointRecord& record) { steps = record.step; });
    FAIL() << "a lateral stretch where there is none";
  } catch (const StepFailure& failure) {
    EXPECT_EQ(failure.kind(), FailureKind::material);
    EXPECT_EQ(steps, 10);
    EXPECT_NE(std::string(failure.what()).find("step 11 (t = 0.55): no lateral stretch"), std::string::npos) << failure.what();
  }
}

/// Message on reading a path.
std::string said_about(const std::string& parameters) {
  struct List {
    Choice<PointPath> path;
    void describe(Parameters& visitor) { visitor.choose(path, point_path_registry(), "the path"); }
  } list;
  std::vector<Diagnostic> diagnostics;
  const Symbols symbols;
  const XmlList root = parse_xml("<ParameterList name=\"path\">\n" + parameters + "</ParameterList>\n", "point.xml");
  read_parameters(list, root, symbols, {}, diagnostics);
  if (diagnostics.empty()) try {
      points_of(*list.path.options);
    } catch (const InputError& error) {
      diagnostics = error.diagnostics();
    }
  std::string text;
  for (const auto& one : diagnostics) text += to_string(one) + "\n";
  return text;
}

std::string parameter(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}

TEST(PointPath, RefusesWhatIsNoDeformation) {
  const auto expect = [](const std::string& parameters, const std::string& message) {
    EXPECT_NE(said_about(parameters).find(message), std::string::npos) << parameters << said_about(parameters);
  };
  EXPECT_EQ(said_about(parameter("type", "uniaxial") + parameter("stretch", "1 + t/2")), "");
  expect(parameter("type", "uniaxial"), "\"stretch\" is missing; please add it, or \"final stretch\"");
  expect(parameter("type", "uniaxial") + parameter("stretch", "1") + parameter("final stretch", "2"), "point.xml:4: error: \"stretch\" is given too");
  expect(parameter("type", "plane strain") + parameter("stretch", "1 - 2*t"), "point.xml:3: error: the stretch \"1 - 2*t\" is 0 at t = 0.5");
  expect(parameter("type", "plane strain") + parameter("final stretch", "-1"), "allowed: > 0");
  expect(parameter("type", "simple shear") + parameter("shear", "x"), "known names: t, pi");
  expect(parameter("type", "simple shear"), "\"shear\" is missing");
  expect(parameter("type", "deformation gradient") + parameter("F22", "1 - t"), "det F is 0 at t = 1");
  expect(parameter("type", "simple shear") + parameter("shear", "t") + parameter("steps", "0"), "\"steps\" is 0; allowed: >= 1");
  expect(parameter("type", "simple sheer"), "did you mean \"simple shear\"?");
}

}  // namespace
}  // namespace mortise
