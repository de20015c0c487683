// Residuals, Jacobians and fluxes are those of one rank, whatever the number of ranks.

#include <gtest/gtest.h>

#include <Tpetra_MultiVector.hpp>

#include "heat_model.hpp"

namespace mortise {
namespace {

using namespace test;

/// All contributions of a body that has everything, at temperatures and displacements that are functions of the place.
struct HeatedBody {
  HeatModel model;
  std::vector<std::shared_ptr<Contribution>> contributions;
  Vector unknowns, velocity;

  HeatedBody(const RCP<Mesh>& mesh, Kinematics kinematics)
      : model(mesh, setup_of(kinematics)),
        unknowns(model.unknowns([](const Position& X) { return 2.0 + std::sin(3.0 * X[0] + X[1] - X[2]); }, displacement(1.0))),
        velocity(model.unknowns([](const Position& X) { return std::cos(X[0] - 2.0 * X[1]); }, displacement(1.0))) {
    contributions = {std::make_shared<HeatConduction>(model.bodies), std::make_shared<HeatCapacity>(model.bodies),
                     std::make_shared<HeatSource>(model.bodies),
                     convection(model, "body/right", function_of([](const std::vector<double>& at) { return 1.0 + at[4] * at[2]; }), 7.0)};
  }
  static VectorField displacement(double factor) {
    return [=](const Position& X) -> Position {
      return {factor * 0.1 * std::sin(X[0] + 2.0 * X[1]), factor * 0.1 * std::cos(2.0 * X[0] - X[2]), factor * 0.1 * X[0] * X[1]};
    };
  }
  static HeatSetup setup_of(Kinematics kinematics) {
    HeatSetup setup;
    setup.kinematics = kinematics;
    setup.displacement = true;
    setup.density = 1.3;
    setup.properties.conductivity = of_temperature([](double theta) { return 1.0 + 0.2 * theta; });
    setup.properties.specific_heat = of_temperature([](double theta) { return 2.0 + 0.1 * theta; });
    setup.properties.source = function_of([](const std::vector<double>& at) { return at[1] * at[4]; });
    return setup;
  }
  Vector residual(Contribution& contribution, const Vector& x, const Vector& v) const {
    Configuration at{0.3, x, x};
    at.velocity = at.local_velocity = &v;
    Vector result(model.space->dofs());
    std::optional<StepFailure> failure;
    contribution.add_residual(at, result, failure);
    throw_if_any(*model.mesh->comm, failure);
    return result;
  }
  /// J d, with the weight 1 of unknowns and 2 of the velocity, and by central differences.
  std::pair<Vector, Vector> derivatives(Contribution& contribution) const {
    const Vector d = model.unknowns([](const Position& X) { return std::sin(X[0] * X[1]) - X[2]; }, displacement(3.0));
    Configuration at{0.3, unknowns, unknowns};
    at.velocity = at.local_velocity = &velocity;
    Matrix jacobian(model.space->graph());
    std::optional<StepFailure> failure;
    contribution.add_jacobian(at, {0.0, 2.0, 1.0, nullptr}, jacobian, failure);
    throw_if_any(*model.mesh->comm, failure);
    jacobian.fillComplete(model.space->dofs(), model.space->dofs());
    Vector product(model.space->dofs()), differences(model.space->dofs());
    jacobian.apply(model.owned(d), product);
    const double h = 1e-5;
    for (const double sign : {1.0, -1.0}) {
      Vector x(unknowns, Teuchos::Copy), v(velocity, Teuchos::Copy);
      x.update(sign * h, d, 1.0);
      v.update(sign * 2.0 * h, d, 1.0);
      differences.update(sign / (2.0 * h), residual(contribution, x, v), 1.0);
    }
    return {product, differences};
  }
};

TEST(HeatOnRanks, ResidualsJacobiansAndFluxesAreThoseOfOneRank) {
  for (const auto& [shape, kinematics] : std::vector<std::pair<CellShape, Kinematics>>{{CellShape::quadrilateral4, Kinematics::plane_strain},
                                                                                       {CellShape::triangle6, Kinematics::axisymmetric},
                                                                                       {CellShape::hexahedron8, Kinematics::three_dimensional},
                                                                                       {CellShape::tetrahedron10, Kinematics::three_dimensional}}) {
    const auto mesh = [&, shape = shape, kinematics = kinematics](const RCP<const Communicator>& comm) {
      return kinematics == Kinematics::three_dimensional ? bar(4, 1.2, shape, comm) : strip(6, 4, 1.2, shape, 1.0, comm);
    };
    const HeatedBody body(mesh(world()), kinematics), alone(mesh(self()), kinematics);
    for (std::size_t n = 0; n < body.contributions.size(); ++n) {
      const std::string name = body.contributions[n]->name();
      const double residual = body.residual(*body.contributions[n], body.unknowns, body.velocity).norm2();
      const double of_one = alone.residual(*alone.contributions[n], alone.unknowns, alone.velocity).norm2();
      EXPECT_NEAR(residual, of_one, 1e-13 * of_one) << name;
      auto [product, differences] = body.derivatives(*body.contributions[n]);
      const double size = alone.derivatives(*alone.contributions[n]).first.norm2();
      EXPECT_NEAR(product.norm2(), size, 1e-12 * size) << name;
      differences.update(-1.0, product, 1.0);
      EXPECT_LE(differences.norm2(), 1e-6 * size) << name;
    }
    std::vector<double> squares{0.0, 0.0};
    for (const auto& flux : body.model.bodies->element_heat_fluxes(body.unknowns, 0)) squares[0] += flux[0] * flux[0];
    for (const auto& flux : alone.model.bodies->element_heat_fluxes(alone.unknowns, 0)) squares[1] += flux[0] * flux[0];
    EXPECT_NEAR(sum_over_ranks(*world(), squares[0]), squares[1], 1e-12 * squares[1]);
    const RCP<MultiVector> nodal = body.model.bodies->nodal_heat_fluxes(body.unknowns);
    const RCP<MultiVector> nodal_alone = alone.model.bodies->nodal_heat_fluxes(alone.unknowns);
    for (int i = 0; i < body.model.mesh->dimension; ++i) {
      const double of_one = nodal_alone->getVector(i)->norm2();
      EXPECT_NEAR(nodal->getVector(i)->norm2(), of_one, 1e-12 * of_one);
    }
  }
}

}  // namespace
}  // namespace mortise
