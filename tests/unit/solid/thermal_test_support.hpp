#pragma once
// Bodies with a temperature: materials, fields and the system of both.

#include <algorithm>
#include <string>

#include "mortise/material/materials.hpp"
#include "solid_test_support.hpp"

namespace mortise {

constexpr double reference_temperature = 293.0;

inline ScalarFunction of_temperature(std::function<double(double)> function) {
  return ScalarFunction([function](const std::vector<double>& arguments) { return function(arguments.at(0)); }, "a function of temperature");
}

/// Gives a material expansion alone, or everything: E, nu, the yield stress and heat depend on the temperature.
inline std::shared_ptr<const MaterialOptions> make_thermal_material(const std::string& law, bool everything, double poissons_ratio = 0.3) {
  const auto material = std::const_pointer_cast<MaterialOptions>(make_material(law, 1000.0, poissons_ratio));
  ThermomechanicalProperties& thermal = material->thermal;
  thermal.reference_temperature = reference_temperature;
  thermal.expansion = 2e-4;
  if (!everything) return material;
  thermal.expansion = of_temperature([](double t) { return 2e-4 * (1.0 + 1e-3 * (t - 293.0)); });
  thermal.youngs_modulus = of_temperature([](double t) { return 1000.0 * std::exp(-1e-3 * (t - 293.0)); });
  thermal.poissons_ratio = of_temperature([=](double t) { return poissons_ratio + 1e-4 * (t - 293.0); });
  thermal.yield_stress_factor = of_temperature([](double t) { return 1.0 / (1.0 + 2e-3 * (t - 293.0)); });
  thermal.thermoelastic_heating = true;
  return material;
}

/// Displacements and a temperature on the nodes of a mesh.
inline std::shared_ptr<const FieldSpace> thermal_space(const RCP<const Mesh>& mesh) {
  const int dimension = mesh->dimension;
  return std::make_shared<FieldSpace>(mesh, std::vector<FieldDeclaration>{{"displacement", dimension}, {"temperature", 1}});
}

struct ThermalSetup {
  ElementType element = ElementType::q4;
  std::string law = "hencky";
  Kinematics kinematics = Kinematics::plane_strain;
  bool everything = true;
  double heat_at_start = 0.0;  ///< share of the start of a step in its heat
};

inline RCP<const Mesh> make_thermal_mesh(const RCP<const Communicator>& comm, const ThermalSetup& setup) {
  if (dimension(setup.kinematics) == 3) {
    BrickSetup brick;
    brick.element = setup.element;
    brick.curved = true;
    return make_brick_mesh(brick);
  }
  BodySetup plane;
  plane.element = setup.element;
  plane.kinematics = setup.kinematics;
  return make_test_mesh(comm, plane);
}

using Temperature = std::function<double(const Point3&)>;

/// Displacement and temperature of positions on the local dofs.
inline Vector thermal_state(const Bodies& bodies, const SpaceField& displacement, const Temperature& temperature) {
  Vector result(bodies.space().local_dofs());
  auto view = result.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (LocalOrdinal node = 0; node < bodies.mesh()->local_count(); ++node) {
    const Point3& X = bodies.mesh()->coordinates[node];
    const Point3 u = displacement(X);
    for (int i = 0; i < bodies.dimension(); ++i) view(bodies.space().row(0, node, i), 0) = u[i];
    view(bodies.space().row(1, node, 0), 0) = temperature(X);
  }
  return result;
}

/// A stretch about (2.5, 0.5, 0.5) after which a smooth disturbance acts; in the plane if the bodies are.
inline SpaceField stretched(double factor) {
  return [=](const Point3& X) -> Point3 {
    return {factor * (0.2 * (X[0] - 2.5) + 0.05 * std::sin(2.0 * X[0] + X[1] - X[2])),
            factor * (-0.12 * (X[1] - 0.5) + 0.05 * std::cos(X[0] - 3.0 * X[1] + X[2])),
            factor * (0.06 * (X[2] - 0.5) + 0.05 * std::sin(X[0] + X[1] - 2.0 * X[2]))};
  };
}

inline Temperature warm(double mean) {
  return [=](const Point3& X) { return mean + 15.0 * std::sin(2.0 * X[0] - X[1] + X[2]); };
}

inline const Temperature at_reference = [](const Point3&) { return reference_temperature; };
inline const SpaceField at_rest = [](const Point3&) -> Point3 { return {}; };

/// At rest, at the reference temperature.
inline std::shared_ptr<Bodies> make_thermal_bodies(const std::shared_ptr<const FieldSpace>& space, const ThermalSetup& setup) {
  const auto bodies = std::make_shared<Bodies>(
      space, setup.kinematics, 0.7, std::vector<BodyProperties>{{"body", {}, make_thermal_material(setup.law, setup.everything), setup.element}},
      setup.heat_at_start);
  bodies->begin(thermal_state(*bodies, at_rest, at_reference));
  return bodies;
}

inline std::shared_ptr<Bodies> make_thermal_bodies(const ThermalSetup& setup) {
  return make_thermal_bodies(thermal_space(make_thermal_mesh(self(), setup)), setup);
}

constexpr double step_length = 0.25;

/// Rows of both fields.
inline Eigen::VectorXd thermal_residual(const Bodies& bodies, const Eigen::VectorXd& x, double time_step = step_length) {
  Vector residual(bodies.space().dofs());
  std::optional<StepFailure> failure;
  bodies.add_internal_force(to_local(bodies, x), residual, failure, time_step);
  if (failure) throw *failure;
  return to_eigen(residual);
}

}  // namespace mortise
