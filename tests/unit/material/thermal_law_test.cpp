// Laws that know the temperature: every derivative against differences, exact stresses, heat.

#include "mortise/material/thermal_law.hpp"

#include <gtest/gtest.h>

#include "mortise/input/read_parameters.hpp"
#include "mortise/material/materials.hpp"
#include "thermal_fixture.hpp"

namespace mortise {
namespace {

const std::vector<std::string> elastic_laws{Hencky::name, NeoHooke::name, CiarletNeoHooke::name, StVenantKirchhoff::name, SmallStrainLinear::name};
const std::vector<std::string> kinds{"expansion", "heating", "everything"};
const std::vector<double> shares_at_start{0.0, 0.5};  // backward Euler, trapezoidal rule

const Matrix3 tilt = rotation(0.7, {1.0, 2.0, -1.0});

/// A deformation with shear and three different stretches.
Matrix3 deformed() { return (Matrix3() << 1.1, 0.1, 0.0, -0.05, 0.93, 0.0, 0.0, 0.0, 1.04).finished(); }

Matrix3 sheared(double shear) {
  Matrix3 F = Matrix3::Identity();
  F(0, 1) = shear;
  return F;
}

TEST(ThermalElasticLaw, DerivativesAreThoseOfDifferences) {
  for (const std::string& name : elastic_laws)
    for (const std::string& kind : kinds)
      for (const double nu : {-0.3, 0.0, 0.3, 0.4})
        for (const double share : shares_at_start) {
          const auto law = make_thermal_law(*elastic_material(name, kind, nu), false, share);
          ThermalState state(*law);
          law->update({tilt * deformed() * tilt.transpose(), 310.0, 315.0}, state.data());
          for (const Deformation& at : solid_states())
            expect_exact(derivative_errors(*law, {at.F, 350.0, 335.0, 0.1}, state.data(), false), name + " " + kind + " " + at.name);
        }
}

TEST(ThermalElasticLaw, DerivativesOfPlaneStressAreThoseOfDifferences) {
  for (const std::string& name : elastic_laws)
    for (const std::string& kind : kinds)
      for (const double nu : {-0.3, 0.0, 0.3, 0.4})
        for (const double share : shares_at_start) {
          const auto law = make_thermal_law(*elastic_material(name, kind, nu), true, share);
          ThermalState state(*law);
          law->update({deformed(), 310.0, 315.0}, state.data());
          for (Deformation& at : plane_states()) {
            at.F(2, 2) = 1.0;
            const ThermalPoint point{at.F, 350.0, 335.0, 0.1};
            if (law->output(point, state.data()).F(2, 2) == 0.0) continue;  // St Venant-Kirchhoff leaves no thickness
            expect_exact(derivative_errors(*law, point, state.data(), true), name + " " + kind + " " + at.name + " " + std::to_string(nu));
            EXPECT_LE(std::abs(law->forces(point, state.data()).stress(2, 2)), 1e-11 * modulus);
          }
        }
}

TEST(ThermalJ2, DerivativesAreThoseOfDifferences) {
  for (const auto& [name, hardening] : every_hardening())
    for (const std::string& kind : kinds)
      for (const double share : shares_at_start) {
        const auto law = make_thermal_law(*j2_material(hardening, kind), false, share);
        ThermalState fresh(*law), flowed(*law);
        law->begin({Matrix3::Identity(), 296.0, 298.0}, fresh.data());
        law->begin({Matrix3::Identity(), 296.0, 298.0}, flowed.data());
        law->update(at_temperature(tilt * (sheared(0.2)) * tilt.transpose(), 300.0), flowed.data());
        law->update({tilt * deformed() * tilt.transpose(), 310.0, 315.0}, flowed.data());
        int plastic = 0;
        for (const ThermalState* state : {&fresh, &flowed})
          for (const Deformation& at : solid_states()) {
            const ThermalPoint point{at.F, 350.0, 335.0, 0.1};
            const bool flows = law->output(point, state->data()).equivalent_plastic_strain > state->data()[6];
            plastic += flows;
            expect_exact(derivative_errors(*law, point, state->data(), false), name + " " + kind + " " + at.name);
          }
        EXPECT_GE(plastic, 30) << name;  // of 42
      }
}

TEST(ThermalJ2, DerivativesOfUnloadingAreThoseOfDifferences) {
  for (const double share : shares_at_start) {
    const auto law = make_thermal_law(*j2_material(LinearHardening{10.0, 60.0}, "everything"), false, share);
    ThermalState state(*law);
    const Matrix3 F = tilt * deformed() * tilt.transpose();
    law->begin(at_temperature(Matrix3::Identity(), 310.0), state.data());
    law->update(at_temperature(F, 310.0), state.data());
    const Matrix3 stress = law->forces(at_temperature(F, 310.0), state.data()).stress;
    const Matrix3 back = (Matrix3::Identity() - 0.5 / modulus * (stress - stress.trace() / 3.0 * Matrix3::Identity())) * F;
    const ThermalPoint point{back, 312.0, 311.0, 0.1};
    EXPECT_EQ(law->output(point, state.data()).equivalent_plastic_strain, state.data()[6]);
    expect_exact(derivative_errors(*law, point, state.data(), false), "unloading");
  }
}

// Without a change of the temperature both ends give the same heat of elastic strain; that of flow takes the yield stresses of both.
TEST(ThermalLaw, TheShareOfTheStartIsThatOfItsTemperatures) {
  const Matrix3 F = tilt * deformed() * tilt.transpose();
  const auto heat = [&](const MaterialOptions& material, double share, double before, double after) {
    const auto law = make_thermal_law(material, false, share);
    ThermalState state(*law);
    law->begin(at_temperature(Matrix3::Identity(), before), state.data());
    return law->forces(at_temperature(F, after), state.data()).heat;
  };
  for (const std::string& name : elastic_laws) {
    const auto material = elastic_material(name, "everything");
    const double cold = heat(*material, 0.0, 310.0, 310.0), hot = heat(*material, 0.0, 350.0, 350.0);
    EXPECT_GT(std::abs(hot - cold), 0.01 * std::abs(hot)) << name;
    EXPECT_NEAR(heat(*material, 0.25, 310.0, 350.0), 0.75 * hot + 0.25 * cold, 1e-12 * modulus) << name;
  }
  const auto material = j2_material(LinearHardening{10.0, 60.0}, "expansion");
  const auto law = make_thermal_law(*material, false);
  ThermalState state(*law);
  const double alpha = law->output(at_temperature(F, 310.0), state.data()).equivalent_plastic_strain;
  EXPECT_GT(alpha, 0.05);
  const double yield = 0.75 * (10.0 + 60.0 * alpha) + 0.25 * 10.0;
  EXPECT_NEAR(heat(*material, 0.25, 310.0, 310.0), ThermomechanicalProperties::usual_plastic_heat_share * yield * alpha / 0.1, 1e-11 * modulus);
}

TEST(ThermalLaw, IsThePlainLawAtTheReferenceTemperatureWithConstantProperties) {
  const auto compare = [](const std::shared_ptr<MaterialOptions>& material, bool plane_stress) {
    const auto law = make_thermal_law(*material, plane_stress);
    std::visit(
        [&](const auto& plain) {
          using Kind = std::decay_t<decltype(plain)>;
          ThermalState state(*law);
          for (const Deformation& at : plane_stress ? plane_states() : solid_states()) {
            const ThermalResponse response = law->respond(at_temperature(at.F, reference_temperature), state.data());
            if constexpr (Kind::plane_stress) {
              if (plane_stress) {
                const auto expected = PlaneStress<Kind>{plain}.template stress_and_tangent<PlaneComponents>(at.F);
                EXPECT_EQ(response.stress, expected.stress) << Kind::name << " " << at.name;
                EXPECT_LE((components_of<PlaneComponents>(response.tangent) - expected.tangent).norm(), 1e-15 * expected.tangent.norm());
                continue;
              }
            }
            const auto expected = Unconstrained<Kind>{plain}.template stress_and_tangent<SolidComponents>(at.F, {});
            EXPECT_EQ(response.stress, expected.stress) << Kind::name << " " << at.name;
            EXPECT_EQ(response.tangent, expected.tangent) << Kind::name << " " << at.name;
            EXPECT_EQ(law->forces(at_temperature(at.F, reference_temperature), state.data()).stress, (Unconstrained<Kind>{plain}.stress(at.F, {})));
          }
        },
        material->law());
  };
  for (const std::string& name : elastic_laws)
    for (const bool plane_stress : {false, true}) compare(elastic_material(name, "expansion"), plane_stress);
  for (const auto& [name, hardening] : every_hardening()) compare(j2_material(hardening, "expansion"), false);
}

std::vector<std::shared_ptr<MaterialOptions>> every_material(const std::string& kind) {
  std::vector<std::shared_ptr<MaterialOptions>> all;
  for (const std::string& name : elastic_laws) all.push_back(elastic_material(name, kind));
  all.push_back(j2_material(LinearHardening{10.0, 60.0}, kind));
  return all;
}

// The thermal strain alpha (theta - theta_0) at 400 with alpha of the fixture.
double thermal_strain(const MaterialOptions& material) { return material.thermal.expansion.at(400.0) * (400.0 - reference_temperature); }

TEST(ThermalLaw, FreeExpansionTakesNoStress) {
  for (const std::string& kind : kinds)
    for (const auto& material : every_material(kind)) {
      const auto law = make_thermal_law(*material, false);
      ThermalState state(*law);
      const double strain = thermal_strain(*material);
      const Matrix3 F = tilt * (law->small_strain() ? 1.0 + strain : std::exp(strain)) * tilt.transpose();
      EXPECT_LE(law->forces(at_temperature(F, 400.0), state.data()).stress.norm(), 1e-14 * modulus) << law->name();
    }
}

TEST(ThermalLaw, ExpansionOfAPlateUnderPlaneStressIsFree) {
  for (const std::string& name : elastic_laws) {
    const auto material = elastic_material(name, "everything");
    const auto law = make_thermal_law(*material, true);
    ThermalState state(*law);
    const double stretch = law->small_strain() ? 1.0 + thermal_strain(*material) : std::exp(thermal_strain(*material));
    Matrix3 F = stretch * Matrix3::Identity();
    F(2, 2) = 1.0;
    const ThermalOutput output = law->output(at_temperature(F, 400.0), state.data());
    EXPECT_LE(output.stress.norm(), 1e-14 * modulus) << name;
    EXPECT_NEAR(output.F(2, 2), stretch, 1e-14) << name;
  }
}

// tau = -3 K alpha (theta - theta_0) I of laws in logarithmic strain and of the linear law, with K and alpha of the temperature.
TEST(ThermalLaw, ConfinedExpansionTakesThePressureOfTheThermalStrain) {
  for (const auto& material : every_material("everything")) {
    const auto law = make_thermal_law(*material, false);
    if (law->name() != std::string(Hencky::name) && law->name() != std::string(FiniteJ2::name) && !law->small_strain()) continue;
    ThermalState state(*law);
    const ElasticConstants constants{material->thermal.youngs_modulus.at(400.0), material->thermal.poissons_ratio.at(400.0)};
    const Matrix3 expected = -3.0 * constants.bulk_modulus() * thermal_strain(*material) * Matrix3::Identity();
    EXPECT_LE((law->forces(at_temperature(Matrix3::Identity(), 400.0), state.data()).stress - expected).norm(), 1e-14 * modulus) << law->name();
  }
}

// One step turns everything by 90 degrees: no heat, and the stress turns with it.
TEST(ThermalLaw, RotationsDoNotHeat) {
  const Matrix3 Q = rotation(0.5 * M_PI, {1.0, -0.3, 2.0});
  for (const auto& material : every_material("everything")) {
    const auto law = make_thermal_law(*material, false);
    if (law->small_strain()) continue;
    ThermalState state(*law);
    const Matrix3 F = tilt * deformed() * tilt.transpose();
    law->update(at_temperature(F, 400.0), state.data());
    const ThermalForces still = law->forces(at_temperature(F, 400.0), state.data()), turned = law->forces(at_temperature(Q * F, 400.0), state.data());
    EXPECT_LE((turned.stress - Q * still.stress * Q.transpose()).norm(), 1e-12 * modulus) << law->name();
    // Round-off of the energy's slope, some 1e-16 E alpha, over the step.
    EXPECT_LE(std::abs(turned.heat), 1e-12 * modulus) << law->name();
  }
}

TEST(ThermalLaw, WithoutALengthOfTheStepNothingHeats) {
  for (const auto& material : every_material("everything")) {
    const auto law = make_thermal_law(*material, false);
    ThermalState state(*law);
    const ThermalPoint at{deformed(), 350.0, 350.0};
    const ThermalResponse response = law->respond(at, state.data());
    EXPECT_EQ(response.heat, 0.0);
    EXPECT_EQ(response.heat_by_gradient, Matrix3(Matrix3::Zero()));
    EXPECT_EQ(response.heat_by_temperature, 0.0);
  }
}

TEST(ThermalLaw, RemembersNothingThatItDoesNotNeed) {
  EXPECT_EQ(make_thermal_law(*elastic_material(Hencky::name, "expansion"), false)->state_size(), 0);
  EXPECT_EQ(make_thermal_law(*elastic_material(Hencky::name, "heating"), false)->state_size(), 3);
  EXPECT_EQ(make_thermal_law(*j2_material(PerfectPlasticity{10.0}, "expansion"), false)->state_size(), 7);
  EXPECT_EQ(make_thermal_law(*j2_material(PerfectPlasticity{10.0}, "everything"), false)->state_size(), 11);
  // The temperatures of the start of a step where they count.
  EXPECT_EQ(make_thermal_law(*elastic_material(Hencky::name, "expansion"), false, 0.5)->state_size(), 0);
  EXPECT_EQ(make_thermal_law(*elastic_material(Hencky::name, "heating"), false, 0.5)->state_size(), 5);
  EXPECT_EQ(make_thermal_law(*j2_material(PerfectPlasticity{10.0}, "everything"), false, 0.5)->state_size(), 13);
}

/// The error of a sequence at the end, with steps halved: 2^order.
double ratio_of_errors(const std::function<double(const ThermalLaw*, int)>& error, const MaterialOptions& material, double share_at_start) {
  const auto law = make_thermal_law(material, false, share_at_start);
  return error(law.get(), 200) / error(law.get(), 400);
}

// Homogeneous change of volume without conduction: rho c d theta = H dt gives theta = theta_0 exp(-3 K alpha ln J / (rho c)) for constant K and
// alpha.
TEST(ThermalLaw, IsentropicChangeOfVolumeHasTheOrderOfTheRule) {
  const double heat_capacity = 3.0, logarithm = 0.3;
  const auto material = elastic_material(Hencky::name, "heating");
  const double expected = reference_temperature * std::exp(-3.0 * material->elastic_constants().bulk_modulus() * 2e-4 * logarithm / heat_capacity);
  const auto error = [&](const ThermalLaw* law, int steps) {
    ThermalState state(*law);
    double temperature = reference_temperature;
    law->begin(at_temperature(Matrix3::Identity(), temperature), state.data());
    for (int n = 1; n <= steps; ++n) {
      const Matrix3 F = std::exp(logarithm * n / steps / 3.0) * Matrix3::Identity();
      const double start = temperature;
      for (int iteration = 0; iteration < 20; ++iteration) {
        const ThermalResponse response = law->respond(at_temperature(F, temperature, 1.0 / steps), state.data());
        temperature -= (heat_capacity * (temperature - start) * steps - response.heat) /
                       (heat_capacity * steps - response.heat_by_expansion - response.heat_by_temperature);
      }
      law->update(at_temperature(F, temperature, 1.0 / steps), state.data());
    }
    return std::abs(temperature - expected);
  };
  EXPECT_LT(expected, reference_temperature - 10.0);  // expansion cools
  EXPECT_NEAR(ratio_of_errors(error, *material, 0.0), 2.0, 0.1);
  EXPECT_NEAR(ratio_of_errors(error, *material, 0.5), 4.0, 0.1);
}

// Simple shear without conduction, perfectly plastic with the factor exp(-w (theta - theta_0)): rho c d theta = chi s(theta) sigma_0 d alpha gives
// theta - theta_0 = ln(1 + w chi sigma_0 alpha / (rho c)) / w with the accumulated plastic strain alpha.
TEST(ThermalJ2, AdiabaticShearHasTheOrderOfTheRule) {
  const double heat_capacity = 0.1, w = 4e-3, yield = 10.0, share = 0.85;
  const auto material = j2_material(PerfectPlasticity{yield}, "expansion");
  material->thermal.expansion = 0.0;
  material->thermal.plastic_heat_share = share;
  material->thermal.yield_stress_factor = of_temperature([w](double t) { return std::exp(-w * (t - reference_temperature)); });
  const auto error = [&](const ThermalLaw* law, int steps) {
    ThermalState state(*law);
    double temperature = reference_temperature;
    law->begin(at_temperature(Matrix3::Identity(), temperature), state.data());
    for (int n = 1; n <= steps; ++n) {
      const Matrix3 F = sheared(2.0 * n / steps);
      const double start = temperature;
      for (int iteration = 0; iteration < 20; ++iteration) {
        const ThermalResponse response = law->respond(at_temperature(F, temperature, 1.0 / steps), state.data());
        temperature -= (heat_capacity * (temperature - start) * steps - response.heat) /
                       (heat_capacity * steps - response.heat_by_expansion - response.heat_by_temperature);
      }
      law->update(at_temperature(F, temperature, 1.0 / steps), state.data());
    }
    const double alpha = state.data()[6];
    EXPECT_GT(alpha, 1.0);
    // What flow has taken is what heats, over chi.
    EXPECT_NEAR(share * state.data()[7], heat_capacity * (temperature - reference_temperature), 1e-10 * yield);
    return std::abs(temperature - reference_temperature - std::log(1.0 + w * share * yield * alpha / heat_capacity) / w);
  };
  EXPECT_NEAR(ratio_of_errors(error, *material, 0.0), 2.0, 0.1);
  EXPECT_NEAR(ratio_of_errors(error, *material, 0.5), 4.0, 0.1);
}

TEST(ThermalLaw, SaysWhatHasNoMeaning) {
  const auto material = j2_material(PerfectPlasticity{10.0}, "everything");
  const auto fault_at = [&](double temperature) {
    const auto law = make_thermal_law(*material, false);
    ThermalState state(*law);
    const ThermalPoint at = at_temperature(Matrix3::Identity(), temperature);
    EXPECT_FALSE(law->forces(at, state.data()).stress.allFinite());
    EXPECT_FALSE(law->respond(at, state.data()).stress.allFinite());
    return law->fault(at, state.data()).value_or("");
  };
  EXPECT_EQ(make_thermal_law(*material, false)->fault(at_temperature(Matrix3::Identity(), 300.0), nullptr), std::nullopt);
  const auto trapezoidal = make_thermal_law(*material, false, 0.5);
  ThermalState cold(*trapezoidal);
  trapezoidal->begin(at_temperature(Matrix3::Identity(), -2.0), cold.data());
  const ThermalPoint warm = at_temperature(Matrix3::Identity(), 300.0);
  EXPECT_FALSE(trapezoidal->forces(warm, cold.data()).stress.allFinite());
  EXPECT_FALSE(trapezoidal->respond(warm, cold.data()).stress.allFinite());
  EXPECT_EQ(trapezoidal->fault(warm, cold.data()), "the temperature is -2; thermoelastic heating needs absolute temperatures, which are above 0");
  EXPECT_EQ(fault_at(-1.0), "the temperature is -1; thermoelastic heating needs absolute temperatures, which are above 0");
  material->thermal.youngs_modulus = TemperatureFunction({300.0, 400.0}, {1000.0, -1000.0});
  EXPECT_EQ(fault_at(375.0), "the Young's modulus of the table is -500 at the temperature 375; it has to be finite and above 0");
  material->thermal.youngs_modulus = {};
  material->thermal.poissons_ratio = 0.5;
  EXPECT_EQ(fault_at(300.0), "the Poisson's ratio \"0.5\" is 0.5 at the temperature 300; it has to be above -1 and below 0.5");
  material->thermal.poissons_ratio = {};
  material->thermal.yield_stress_factor = 0.0;
  EXPECT_EQ(fault_at(300.0), "the yield stress factor \"0\" is 0 at the temperature 300; it has to be finite and above 0");
  material->thermal.yield_stress_factor = {};
  material->thermal.expansion = of_temperature([](double t) { return std::sqrt(300.0 - t); });
  EXPECT_EQ(fault_at(301.0), "the expansion coefficient \"a function of temperature\" is nan at the temperature 301; it has to be finite");
  EXPECT_THROW(make_thermal_law(*material, true), std::invalid_argument);
  material->thermal.reference_temperature.reset();
  EXPECT_THROW(make_thermal_law(*material, false), std::invalid_argument);
}

/// Messages on reading a material with these entries of its list "thermomechanics"; it ends up in `material`.
std::string refused(MaterialOptions& material, const std::string& entries) {
  const auto number = [](const std::string& name, const std::string& value) {
    return "<Parameter name=\"" + name + "\" type=\"double\" value=\"" + value + "\"/>\n";
  };
  std::string hardening;
  if (dynamic_cast<FiniteJ2Options*>(&material) != nullptr)
    hardening = "<ParameterList name=\"hardening\">\n<Parameter name=\"type\" type=\"string\" value=\"perfect\"/>\n" + number("yield stress", "10") +
                "</ParameterList>\n";
  const XmlList root = parse_xml("<ParameterList name=\"steel\">\n" + number("young's modulus", "1000") + number("poisson's ratio", "0.3") +
                                     hardening + "<ParameterList name=\"thermomechanics\">\n" + entries + "</ParameterList>\n</ParameterList>\n",
                                 "law.xml");
  std::vector<Diagnostic> diagnostics;
  read_parameters(material, root, Symbols(), {}, diagnostics);
  std::string text;
  for (const auto& one : diagnostics) text += to_string(one) + "\n";
  return text;
}

std::string entry(const std::string& name, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"string\" value=\"" + value + "\"/>\n";
}

TEST(ThermalOptions, AreReadAndChecked) {
  const std::string reference = entry("reference temperature", "293");
  ElasticMaterialOptions<Hencky> elastic;
  EXPECT_EQ(refused(elastic, ""), "");
  EXPECT_FALSE(elastic.thermal.given());
  EXPECT_EQ(refused(elastic, reference + entry("expansion coefficient", "1e-5 * temperature")), "");
  ASSERT_TRUE(elastic.thermal.given());
  EXPECT_NEAR(elastic.thermal.expansion.at(400.0), 4e-3, 1e-15);
  const auto expect_refused = [&](MaterialOptions&& material, const std::string& entries, const std::string& message) {
    const std::string text = refused(material, entries);
    EXPECT_NE(text.find(message), std::string::npos) << text;
  };
  using Elastic = ElasticMaterialOptions<Hencky>;
  expect_refused(Elastic(), entry("expansion coefficient", "1e-5"), "\"reference temperature\" is missing");
  expect_refused(Elastic(), reference + entry("young's modulus", "900 + temperature - 293"),
                 "\"young's modulus\" is 900 at the reference temperature 293; it has to be 1000 there");
  expect_refused(Elastic(), reference + entry("yield stress factor", "1"), "unknown parameter \"yield stress factor\"");
  expect_refused(FiniteJ2Options(), reference + entry("yield stress factor", "2"), "it has to be 1 there");
  expect_refused(FiniteJ2Options(), reference + entry("plastic heat share", "1.5"), "\"plastic heat share\"");
  FiniteJ2Options plastic;
  EXPECT_EQ(refused(plastic, reference + entry("yield stress factor", "1 - 1e-3 * (temperature - 293)")), "");
  EXPECT_EQ(make_thermal_law(plastic, false)->state_size(), 8);
}

}  // namespace
}  // namespace mortise
