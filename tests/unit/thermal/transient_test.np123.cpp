// Capacity in time: uniform heating, a body that cools, the decay of a mode, with consistent and lumped capacity.

#include <gtest/gtest.h>

#include "heat_model.hpp"

namespace mortise {
namespace {

using namespace test;

/// Backward Euler from temperatures `start` to `end` in equal steps.
Vector walk(const HeatModel& model, const std::vector<std::shared_ptr<Contribution>>& contributions,
            const std::vector<Named<PrescribedTemperatureOptions>>& prescribed, const Field& start, double end, int steps, double size) {
  const auto system =
      heat_system(model, contributions, prescribed, size, std::make_shared<TimeIntegration>(TimeIntegration{backward_euler(), {}, {}}));
  Vector x(system->map());
  const Vector at_start = model.owned(model.unknowns(start));
  system->unknowns(x)->update(1.0, at_start, 0.0);
  SteppingOptions stepping;
  stepping.end_time = end;
  stepping.step = end / steps;
  NewtonOptions newton;
  newton.momentum_tolerance = 1e-12;
  SteppingState at(system->initial_state(x, Vector(model.space->dofs()), true));
  std::optional<StepFailure> failure;
  run_steps(*system, stepping, newton, at, {}, {}, failure);
  if (failure) throw *failure;
  Vector result(model.space->local_dofs());
  result.doImport(*system->unknowns(*at.accepted.x), *model.space->ghost_import(), Tpetra::REPLACE);
  return result;
}

HeatSetup setup_of(bool lumped) {
  HeatSetup setup;
  setup.properties.conductivity = 2.0;
  setup.properties.specific_heat = 0.5;
  setup.properties.lumped_capacity = lumped;
  setup.density = 3.0;
  return setup;
}

std::vector<std::shared_ptr<Contribution>> bulk_of(const HeatModel& model) {
  return {std::make_shared<HeatConduction>(model.bodies), std::make_shared<HeatCapacity>(model.bodies)};
}

// Uniform: rho c(theta_1) (theta_1 - theta_0) / dt = R, in each step a quadratic equation of theta_1 with c = c_0 + c_1 theta.
TEST(HeatInTime, AUniformSourceHeatsAsTheScalarEquation) {
  for (const bool lumped : {false, true}) {
    HeatSetup setup = setup_of(lumped);
    const double R = 7.0, c0 = 0.5, c1 = 0.1, end = 2.0;
    const int steps = 4;
    setup.properties.specific_heat = of_temperature([=](double theta) { return c0 + c1 * theta; });
    setup.properties.source = R;
    const HeatModel model(strip(4, 3, 1.5), setup);
    auto contributions = bulk_of(model);
    contributions.push_back(std::make_shared<HeatSource>(model.bodies));
    double theta = 1.0;
    for (int n = 0; n < steps; ++n) {
      const double b = c0 - c1 * theta, c = -c0 * theta - R * end / steps / setup.density;
      theta = (-b + std::sqrt(b * b - 4.0 * c1 * c)) / (2.0 * c1);
    }
    EXPECT_LE(largest_error(model,
                            walk(
                                model, contributions, {}, [](const Position&) { return 1.0; }, end, steps, 1.0),
                            [&](const Position&) { return theta; }),
              1e-9 * theta);
  }
}

// A body that conducts well cools as one temperature: theta - theta_s falls by 1 / (1 + h A dt / (rho c V)) in a step, up to h L / k.
TEST(HeatInTime, ABodyOfOneTemperatureCools) {
  for (const bool lumped : {false, true}) {
    HeatSetup setup = setup_of(lumped);
    setup.properties.conductivity = 1e6;
    setup.kinematics = Kinematics::three_dimensional;
    const HeatModel model(bar(3, 1.5), setup);
    auto contributions = bulk_of(model);
    contributions.push_back(convection(model, "body/surface", 0.6, 10.0));
    const double area = 2.0 * (1.5 + 1.5 + 1.0), volume = 1.5, dt = 0.25;
    const double factor = 1.0 / (1.0 + 0.6 * area * dt / (3.0 * 0.5 * volume));
    const Vector end = walk(
        model, contributions, {}, [](const Position&) { return 50.0; }, 4.0 * dt, 4, 50.0);
    EXPECT_LE(largest_error(model, end, [&](const Position&) { return 10.0 + 40.0 * std::pow(factor, 4); }), 0.6 * 1.5 / 1e6 * 50.0);
  }
}

// cos(pi x) between insulated ends. Linear cells of length h have it for a mode that decays at the rate
//   (k / rho c) (6 / h^2) (1 - cos pi h) / (2 + cos pi h),  lumped (k / rho c) (2 / h^2) (1 - cos pi h),
// of which backward Euler makes 1 / (1 + rate dt) in a step.
TEST(HeatInTime, AModeDecaysAtTheRateOfTheElements) {
  const int cells = 8, steps = 10;
  const double h = 1.0 / cells, c = std::cos(EIGEN_PI * h), diffusivity = 2.0 / (3.0 * 0.5), end = 0.1;
  for (const bool lumped : {false, true}) {
    const HeatModel model(strip(cells, 1, 1.0), setup_of(lumped));
    const double rate = diffusivity * (lumped ? 2.0 : 6.0 / (2.0 + c)) / (h * h) * (1.0 - c);
    const Field start = [](const Position& X) { return std::cos(EIGEN_PI * X[0]); };
    const Vector after = walk(model, bulk_of(model), {}, start, end, steps, 1.0);
    const double left = std::pow(1.0 + rate * end / steps, -steps);
    EXPECT_LE(largest_error(model, after, [&](const Position& X) { return left * std::cos(EIGEN_PI * X[0]); }), 1e-9);
  }
}

TEST(HeatInTime, BackwardEulerIsOfFirstOrder) {
  const HeatModel model(strip(16, 1, 1.0, CellShape::quadrilateral8), setup_of(false));
  const Field start = [](const Position& X) { return std::cos(EIGEN_PI * X[0]); };
  const double end = 0.1, left = std::exp(-EIGEN_PI * EIGEN_PI * 2.0 / 1.5 * end);
  const auto error = [&](int steps) {
    return largest_error(model, walk(model, bulk_of(model), {}, start, end, steps, 1.0),
                         [&](const Position& X) { return left * std::cos(EIGEN_PI * X[0]); });
  };
  EXPECT_NEAR(std::log2(error(20) / error(40)), 1.0, 0.15);
}

// The rate of the heat that a body stores is rho c V times a uniform rate, and what is lumped sums to the same.
TEST(HeatInTime, TheSumOfTheRowsOfCapacityIsTheRateOfStoredHeat) {
  for (const bool lumped : {false, true}) {
    const HeatModel model(strip(4, 3, 1.5), setup_of(lumped));
    HeatCapacity capacity(model.bodies);
    const Vector theta = model.unknowns([](const Position&X) { return X[0]; }), rate = model.unknowns([](const Position&X) { return 2.0 + X[1]; });
    Configuration at{0.0, theta, theta};
    at.velocity = at.local_velocity = &rate;
    EXPECT_NEAR(heat_of(capacity, model, at), 3.0 * 0.5 * 0.7 * 1.5 * 2.5, 1e-13 * 4.0);
  }
}

}  // namespace
}  // namespace mortise
