// Loads on sides against closed forms, their balance with reactions, and agreement of ranks.

#include <gtest/gtest.h>

#include "heat_model.hpp"

namespace mortise {
namespace {

using namespace test;

/// Power that prescribed nodes of a set take out of the body, over all ranks.
double reaction_of(const HeatModel& model, const SteadyHeat& solved, const std::string& set) {
  const auto forces = solved.forces.getLocalViewHost(Tpetra::Access::ReadOnly);
  double power = 0.0;
  for (const LocalOrdinal node : model.mesh->node_sets.at(set))
    if (node < model.mesh->owned_count()) power += forces(model.space->row(model.bodies->temperature(), node, 0), 0);
  return sum_over_ranks(*model.mesh->comm, power);
}

Configuration at_end(const SteadyHeat& solved) { return {0.0, solved.unknowns, solved.unknowns}; }

/// Walls of width 1.2 between x = 0 (2 in a ring) and their right side, in all kinematics.
std::vector<std::pair<HeatModel, double>> walls() {  // with the area of the right side
  HeatSetup setup;
  setup.properties.conductivity = 3.0;
  std::vector<std::pair<HeatModel, double>> all;
  for (const CellShape shape : {CellShape::quadrilateral4, CellShape::triangle3, CellShape::quadrilateral8, CellShape::triangle6})
    all.emplace_back(HeatModel(strip(5, 3, 1.2, shape), setup), setup.thickness);
  setup.kinematics = Kinematics::three_dimensional;
  for (const CellShape shape : {CellShape::hexahedron8, CellShape::tetrahedron4, CellShape::hexahedron20})
    all.emplace_back(HeatModel(bar(4, 1.2, shape), setup), 1.0);
  return all;
}

// q = (theta_0 - theta_s) / (L/k + 1/h).
TEST(HeatLoads, AWallWithConvection) {
  const double L = 1.2, k = 3.0, h = 0.8, hot = 30.0, cold = 10.0, q = (hot - cold) / (L / k + 1.0 / h);
  for (const auto& [model, area] : walls()) {
    const auto load = convection(model, "body/right", h, cold);
    const auto conduction = std::make_shared<HeatConduction>(model.bodies);
    const SteadyHeat solved = solve_steady(model, {conduction, load}, {prescribe("body/left", hot)}, hot);
    EXPECT_LE(solved.newton_steps, 2);
    EXPECT_LE(largest_error(model, solved.unknowns, [&](const Position& X) { return hot - q * X[0] / k; }), 1e-12 * hot);
    EXPECT_NEAR(-heat_of(*load, model, at_end(solved)), -q * area, 1e-11 * q * area);
    EXPECT_NEAR(reaction_of(model, solved, "body/left"), q * area, 1e-11 * q * area);
    EXPECT_NEAR(heat_of(*conduction, model, at_end(solved)), 0.0, 1e-11 * q * area);
  }
}

// Of a ring: q r = (theta_0 - theta_s) / (ln(b/a)/k + 1/(b h)); linear cells have it with (h/r)^2.
TEST(HeatLoads, ARingWithConvectionHasTheAreaOfItsCircumference) {
  const double a = 2.0, b = 3.0, k = 3.0, h = 0.8, qr = 20.0 / (std::log(b / a) / k + 1.0 / (b * h));
  HeatSetup setup;
  setup.properties.conductivity = k;
  setup.kinematics = Kinematics::axisymmetric;
  const HeatModel model(strip(64, 1, b - a, CellShape::quadrilateral4, a), setup);
  const auto load = convection(model, "body/right", h, 10.0);
  const SteadyHeat solved = solve_steady(model, {std::make_shared<HeatConduction>(model.bodies), load}, {prescribe("body/left", 30.0)}, 30.0);
  EXPECT_NEAR(heat_of(*load, model, at_end(solved)), 2.0 * EIGEN_PI * qr, 2.0 * EIGEN_PI * qr / (64.0 * 64.0));
}

// k (theta_0 - theta) / L = e s (theta^4 - theta_s^4).
TEST(HeatLoads, AWallThatRadiates) {
  const double L = 1.2, k = 3.0, factor = 0.9 * 5.67e-8, hot = 900.0, cold = 300.0;
  double theta = hot;
  for (int n = 0; n < 30; ++n)
    theta -= (k * (theta - hot) / L + factor * (std::pow(theta, 4) - std::pow(cold, 4))) / (k / L + 4.0 * factor * std::pow(theta, 3));
  for (const auto& [model, area] : walls()) {
    const auto load = load_on<RadiationOptions>(model, "body/right", [&](RadiationOptions& options) {
      options.emissivity = 0.9;
      options.stefan_boltzmann = 5.67e-8;
      options.surroundings = cold;
    });
    const SteadyHeat solved = solve_steady(model, {std::make_shared<HeatConduction>(model.bodies), load}, {prescribe("body/left", hot)}, hot, hot);
    EXPECT_LE(largest_error(model, solved.unknowns, [&](const Position& X) { return hot + (theta - hot) * X[0] / L; }), 1e-10 * hot);
    EXPECT_NEAR(heat_of(*load, model, at_end(solved)), k * (hot - theta) / L * area, 1e-9 * k * hot * area);
  }
}

// A flux that falls with the temperature, q = 12 - 0.4 theta, is convection.
TEST(HeatLoads, AFluxThatDependsOnTheTemperature) {
  for (const auto& [model, area] : walls()) {
    const auto load = heat_flux(model, "body/right", function_of([](const std::vector<double>& at) { return 12.0 - 0.4 * at[4]; }));
    const SteadyHeat solved = solve_steady(model, {std::make_shared<HeatConduction>(model.bodies), load}, {prescribe("body/left", 5.0)}, 30.0);
    const double q = (30.0 - 5.0) / (1.2 / 3.0 + 1.0 / 0.4);
    EXPECT_LE(largest_error(model, solved.unknowns, [&](const Position& X) { return 5.0 + q * X[0] / 3.0; }), 1e-11 * 30.0);
    EXPECT_NEAR(-heat_of(*load, model, at_end(solved)), q * area, 1e-10 * q * area);
  }
}

// What sources and fluxes bring leaves through the prescribed side: the rows sum to 0.
TEST(HeatLoads, AllRowsAreInBalance) {
  for (const auto& [model, area] : walls()) {
    HeatSetup setup;
    setup.kinematics = model.bodies->kinematics();
    setup.properties.conductivity = of_temperature([](double theta) { return 3.0 + 0.02 * theta; });
    setup.properties.source = function_of([](const std::vector<double>& at) { return 4.0 + at[1] * at[2] - 0.1 * at[4]; });
    const HeatModel heated(rcp(new Mesh(*model.mesh)), setup);
    const auto conduction = std::make_shared<HeatConduction>(heated.bodies);
    const auto source = std::make_shared<HeatSource>(heated.bodies);
    const auto load = heat_flux(heated, "body/top", function_of([](const std::vector<double>& at) { return 2.0 + at[1]; }));
    const SteadyHeat solved = solve_steady(heated, {conduction, source, load}, {prescribe("body/left", 5.0), prescribe("body/right", 8.0)}, 10.0);
    const double in = -heat_of(*source, heated, at_end(solved)) - heat_of(*load, heated, at_end(solved));
    const double out = reaction_of(heated, solved, "body/left") + reaction_of(heated, solved, "body/right");
    EXPECT_GT(in, 4.0 * area);
    EXPECT_NEAR(out, -in, 1e-10 * in);
    EXPECT_NEAR(heat_of(*conduction, heated, at_end(solved)), 0.0, 1e-11 * in);
  }
}

}  // namespace
}  // namespace mortise
