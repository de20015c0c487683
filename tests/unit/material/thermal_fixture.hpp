#pragma once
// Materials that know the temperature, for the tests of thermal laws.

#include <cmath>
#include <memory>
#include <string>

#include "law_fixture.hpp"
#include "mortise/material/thermal_law.hpp"
#include "plasticity_fixture.hpp"

namespace mortise {

constexpr double reference_temperature = 293.0, modulus = 1000.0;

/// J2 plasticity with a given curve.
struct J2Material : MaterialOptions {
  Hardening hardening;
  Law law() const override { return FiniteJ2(elastic_constants(), hardening); }
};

inline ScalarFunction of_temperature(std::function<double(double)> function) {
  return ScalarFunction([function](const std::vector<double>& arguments) { return function(arguments.at(0)); }, "a function of temperature");
}

/// Young's modulus 1000; what varies falls or rises with the temperature by some percent in 100 degrees.
inline void set_properties(MaterialOptions& material, const std::string& kind) {
  const double nu = material.poissons_ratio;
  material.youngs_modulus = modulus;
  ThermomechanicalProperties& thermal = material.thermal;
  thermal.reference_temperature = reference_temperature;
  thermal.expansion = 2e-4;
  if (kind == "expansion") return;
  thermal.thermoelastic_heating = true;
  if (kind == "heating") return;
  thermal.expansion = of_temperature([](double t) { return 2e-4 * (1.0 + 1e-3 * (t - 293.0) + 1e-6 * t * t); });
  thermal.youngs_modulus = of_temperature([](double t) { return modulus * std::exp(-1e-3 * (t - 293.0)); });
  thermal.poissons_ratio = of_temperature([nu](double t) { return nu + 1e-4 * (t - 293.0) + 3e-7 * (t - 293.0) * (t - 293.0); });
  thermal.yield_stress_factor = of_temperature([](double t) { return 1.0 / (1.0 + 2e-3 * (t - 293.0)); });
}

inline std::shared_ptr<MaterialOptions> elastic_material(const std::string& law, const std::string& kind, double nu = 0.3) {
  for (const auto& entry : material_registry().entries())
    if (entry.name == law) {
      const auto material = entry.make();
      material->poissons_ratio = nu;
      set_properties(*material, kind);
      return material;
    }
  throw std::logic_error("no law " + law);
}

inline std::shared_ptr<MaterialOptions> j2_material(const Hardening& hardening, const std::string& kind) {
  const auto material = std::make_shared<J2Material>();
  material->hardening = hardening;
  set_properties(*material, kind);
  return material;
}

/// The memory of a point.
class ThermalState {
 public:
  explicit ThermalState(const ThermalLaw& law) : values_(law.state_size() + 1) { law.start(values_.data()); }
  const double* data() const { return values_.data(); }
  double* data() { return values_.data(); }

 private:
  std::vector<double> values_;  ///< with one more, so that there is an address
};

inline ThermalPoint at_temperature(const Matrix3& F, double temperature, double time_step = 0.1) { return {F, temperature, temperature, time_step}; }

/// Largest deviations of derivatives from differences, each relative to the largest of its kind.
struct DerivativeErrors {
  double tangent, stress_by_expansion, stress_by_temperature, heat_by_gradient, heat_by_expansion, heat_by_temperature;
};

inline double relative(double error, double size) { return error == 0.0 ? 0.0 : error / size; }

/// @param in_plane  L has the components of the plane alone
inline DerivativeErrors derivative_errors(const ThermalLaw& law, const ThermalPoint& at, const double* state, bool in_plane) {
  const ThermalResponse response = law.respond(at, state);
  const ThermalForces forces = law.forces(at, state);
  EXPECT_LE((response.stress - forces.stress).norm(), 1e-13 * (modulus + forces.stress.norm()));
  EXPECT_LE(std::abs(response.heat - forces.heat), 1e-12 * (modulus + std::abs(forces.heat)));
  const auto by = [&](const std::function<void(ThermalPoint&, double)>& move) {
    // Stress and heat in one, which difference() takes apart.
    return difference([&](double t) {
      ThermalPoint moved = at;
      move(moved, t);
      const ThermalForces f = law.forces(moved, state);
      Eigen::Matrix<double, 10, 1> values;
      for (int p = 0; p < 9; ++p) values(p) = f.stress(p / 3, p % 3);
      values(9) = f.heat;
      return values;
    });
  };
  DerivativeErrors errors{};
  double largest_tangent = 0.0, largest_heat = 0.0;
  for (int q = 0; q < 9; ++q) {
    const int k = q / 3, l = q % 3;
    if (in_plane && (k == 2 || l == 2)) continue;
    const auto slope = by([&](ThermalPoint& point, double t) {
      Matrix3 L = Matrix3::Zero();
      L(k, l) = t;
      point.F += law.small_strain() ? L : Matrix3(L * point.F);
    });
    for (int p = 0; p < 9; ++p) {
      const int i = p / 3, j = p % 3;
      if (in_plane && (i == 2 || j == 2)) continue;
      const double geometric = law.small_strain() || j != k ? 0.0 : response.stress(i, l);
      errors.tangent = std::max(errors.tangent, std::abs(response.tangent(p, q) - (slope(p) - geometric)));
      largest_tangent = std::max(largest_tangent, std::abs(response.tangent(p, q)));
    }
    errors.heat_by_gradient = std::max(errors.heat_by_gradient, std::abs(response.heat_by_gradient(k, l) - slope(9)));
    largest_heat = std::max(largest_heat, std::abs(slope(9)));
  }
  errors.tangent /= largest_tangent;
  errors.heat_by_gradient = relative(errors.heat_by_gradient, largest_heat);
  // The temperature moves by this times the step of difference(). Slopes of expressions have errors of 1e-10, so that shorter moves say nothing.
  constexpr double range = 8e3;
  const auto by_expansion = by([](ThermalPoint& point, double t) { point.expansion_temperature += range * t; });
  const auto by_temperature = by([](ThermalPoint& point, double t) { point.temperature += range * t; });
  double largest_expansion = 0.0, largest_temperature = 0.0;
  for (int p = 0; p < 9; ++p) {
    const int i = p / 3, j = p % 3;
    if (in_plane && (i == 2 || j == 2)) continue;
    errors.stress_by_expansion = std::max(errors.stress_by_expansion, std::abs(range * response.stress_by_expansion(i, j) - by_expansion(p)));
    errors.stress_by_temperature = std::max(errors.stress_by_temperature, std::abs(range * response.stress_by_temperature(i, j) - by_temperature(p)));
    largest_expansion = std::max(largest_expansion, std::abs(by_expansion(p)));
    largest_temperature = std::max(largest_temperature, std::abs(by_temperature(p)));
  }
  // A round-off of the stress of 1e-13 E over the step of 1e-4 is 1e-9 E: smaller derivatives say nothing.
  errors.stress_by_expansion /= std::max(largest_expansion, 1e-2 * modulus);
  errors.stress_by_temperature /= std::max(largest_temperature, 1e-2 * modulus);
  // The heat may hardly depend on a temperature; it does so on scales of heat_by_gradient.
  errors.heat_by_expansion =
      relative(std::abs(range * response.heat_by_expansion - by_expansion(9)), std::max(largest_heat, std::abs(by_expansion(9))));
  errors.heat_by_temperature =
      relative(std::abs(range * response.heat_by_temperature - by_temperature(9)), std::max(largest_heat, std::abs(by_temperature(9))));
  return errors;
}

inline void expect_exact(const DerivativeErrors& errors, const std::string& what) {
  EXPECT_LE(errors.tangent, bound) << what;
  EXPECT_LE(errors.stress_by_expansion, bound) << what;
  EXPECT_LE(errors.stress_by_temperature, bound) << what;
  EXPECT_LE(errors.heat_by_gradient, bound) << what;
  EXPECT_LE(errors.heat_by_expansion, bound) << what;
  EXPECT_LE(errors.heat_by_temperature, bound) << what;
}

}  // namespace mortise
