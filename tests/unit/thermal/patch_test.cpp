// What elements have exactly: linear temperatures on distorted meshes, rotations, homogeneous stretches, fluxes.

#include <gtest/gtest.h>

#include <Tpetra_MultiVector.hpp>

#include "heat_model.hpp"

namespace mortise {
namespace {

using namespace test;

HeatSetup setup_of(CellShape shape, ConductivityActsIn acts_in = ConductivityActsIn::current, bool displacement = false) {
  HeatSetup setup;
  setup.properties.conductivity = 3.0;
  setup.properties.acts_in = acts_in;
  setup.kinematics = topology(shape).dimension == 3 ? Kinematics::three_dimensional : Kinematics::plane_strain;
  setup.displacement = displacement;
  return setup;
}

Vector conduction_residual(const HeatModel& model, const Vector& local_unknowns) {
  HeatConduction conduction(model.bodies);
  Vector residual(model.space->dofs());
  std::optional<StepFailure> failure;
  conduction.add_residual({0.0, local_unknowns, local_unknowns}, residual, failure);
  if (failure) throw *failure;
  return residual;
}

void expect_linear(const HeatModel& model, const Position& gradient, const std::string& what) {
  const Field exact = [&](const Position& X) { return 5.0 + gradient[0] * X[0] + gradient[1] * X[1] + gradient[2] * X[2]; };
  const auto conduction = std::make_shared<HeatConduction>(model.bodies);
  const SteadyHeat solved = solve_steady(model, {conduction}, {prescribe("body/surface", of_place(exact))}, 10.0);
  EXPECT_LE(largest_error(model, solved.unknowns, exact), 1e-12 * 10.0) << what;
  for (const auto& flux : model.bodies->element_heat_fluxes(solved.unknowns, 0))
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(flux[i], -3.0 * gradient[i], 1e-11 * 3.0 * 10.0) << what;
  const RCP<MultiVector> nodal = model.bodies->nodal_heat_fluxes(solved.unknowns);
  ASSERT_EQ(nodal->getNumVectors(), static_cast<std::size_t>(model.mesh->dimension));
  const auto view = nodal->getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t node = 0; node < view.extent(0); ++node)
    for (int i = 0; i < model.mesh->dimension; ++i) EXPECT_NEAR(view(node, i), -3.0 * gradient[i], 1e-11 * 3.0 * 10.0) << what;
}

TEST(HeatPatch, LinearTemperaturesAreExactOnDistortedMeshes) {
  for (const int dimension : {2, 3})
    for (const CellShape shape : cells_of(dimension)) {
      const HeatModel model(distorted_mesh(shape, 2, 0.15), setup_of(shape));
      expect_linear(model, {1.5, -0.7, dimension == 3 ? 0.9 : 0.0}, std::to_string(topology(shape).nodes) + " nodes");
    }
}

TEST(HeatPatch, OfARingIsLinearAlongTheAxis) {
  for (const CellShape shape : cells_of(2)) {
    HeatSetup setup = setup_of(shape);
    setup.kinematics = Kinematics::axisymmetric;
    expect_linear(HeatModel(distorted_mesh(shape, 2, 0.15), setup), {0.0, 1.5, 0.0}, std::to_string(topology(shape).nodes) + " nodes");
  }
}

// With k in the current configuration heat does not see rotations.
TEST(HeatPatch, ARotationBy90DegreesChangesNothing) {
  for (const ConductivityActsIn acts_in : {ConductivityActsIn::current, ConductivityActsIn::without_volume_ratio})
    for (const int dimension : {2, 3})
      for (const CellShape shape : cells_of(dimension)) {
        const HeatModel model(distorted_mesh(shape, 1, 0.15, true), setup_of(shape, acts_in, true));
        const Field theta = [](const Position& X) { return std::sin(2.0 * X[0]) + X[1] * X[1] - X[2]; };
        const Vector at_rest = model.unknowns(theta);
        const Vector turned = model.unknowns(theta, [](const Position& X) -> Position { return {-X[1] - X[0], X[0] - X[1], 0.0}; });
        Vector difference = conduction_residual(model, at_rest);
        const double size = difference.normInf();
        difference.update(-1.0, conduction_residual(model, turned), 1.0);
        EXPECT_LE(difference.normInf(), 1e-13 * size);
        const auto before = model.bodies->element_heat_fluxes(at_rest, 0), after = model.bodies->element_heat_fluxes(turned, 0);
        for (std::size_t e = 0; e < before.size(); ++e) {
          EXPECT_NEAR(after[e][0], -before[e][1], 1e-12 * size);
          EXPECT_NEAR(after[e][1], before[e][0], 1e-12 * size);
          EXPECT_NEAR(after[e][2], before[e][2], 1e-12 * size);
        }
      }
}

// Stretches a, b, c along the axes, temperature G X: the flux through the side x is k G times b c/a, 1 or 1/a^2 per reference area, with c = 1 in the
// plane and c = b = 1 + u_r/R, which needs u_r = (b - 1) R, in a ring that is stretched along its axis y.
TEST(HeatPatch, FluxThroughAStretchedBody) {
  const double a = 1.3, b = 0.8, c = 1.1, G = 2.0, k = 3.0;
  for (const auto& [name, acts_in] : conductivity_names())
    for (const Kinematics kinematics : {Kinematics::plane_strain, Kinematics::axisymmetric, Kinematics::three_dimensional})
      for (const CellShape shape : cells_of(dimension(kinematics))) {
        HeatSetup setup = setup_of(shape, acts_in, true);
        setup.kinematics = kinematics;
        const HeatModel model(distorted_mesh(shape, 1, 0.0), setup);
        const bool ring = kinematics == Kinematics::axisymmetric, in_space = kinematics == Kinematics::three_dimensional;
        const int along = ring ? 1 : 0;
        const Vector x = model.unknowns([&](const Position& X) { return G * X[along]; },
                                        [&](const Position& X) -> Position {
                                          if (ring) return {(b - 1.0) * X[0], (a - 1.0) * X[1], 0.0};
                                          return {(a - 1.0) * X[0], (b - 1.0) * X[1], (c - 1.0) * X[2]};
                                        });
        const double across = ring ? b * b : in_space ? b * c : b;
        const double factor = acts_in == ConductivityActsIn::current ? across / a : acts_in == ConductivityActsIn::reference ? 1.0 : 1.0 / (a * a);
        const double area = ring ? EIGEN_PI * (9.0 - 4.0) : in_space ? 1.0 : setup.thickness;
        const Vector residual = conduction_residual(model, x);
        const auto rows = residual.getLocalViewHost(Tpetra::Access::ReadOnly);
        double through = 0.0, all = 0.0;
        for (LocalOrdinal node = 0; node < model.mesh->owned_count(); ++node) {
          const double row = rows(model.space->row(model.bodies->temperature(), node, 0), 0);
          all += row;
          if (model.mesh->coordinates[node][along] > (ring ? 0.0 : 2.0) + 1.0 - 1e-12) through += row;
        }
        EXPECT_NEAR(through, k * G * factor * area, 1e-12 * k * G * area) << name << ", " << to_string(kinematics);
        EXPECT_NEAR(all, 0.0, 1e-12 * k * G * area);
        // Per current area.
        for (const auto& flux : model.bodies->element_heat_fluxes(x, 0)) EXPECT_NEAR(flux[along], -k * G * factor / across, 1e-12 * k * G);
      }
}

}  // namespace
}  // namespace mortise
