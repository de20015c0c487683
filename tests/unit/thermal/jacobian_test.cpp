// Jacobians against central differences: every contribution, cell, configuration and kinematics, on distorted and deformed bodies.

#include <gtest/gtest.h>

#include "heat_model.hpp"

namespace mortise {
namespace {

using namespace test;

Eigen::VectorXd to_eigen(const Vector& vector) {
  const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
  return Eigen::Map<const Eigen::VectorXd>(view.data(), static_cast<Eigen::Index>(view.extent(0)));
}
Vector to_vector(const RCP<const Map>& map, const Eigen::VectorXd& values) {
  Vector vector(map);
  const auto view = vector.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (Eigen::Index i = 0; i < values.size(); ++i) view(i, 0) = values[i];
  return vector;
}
Eigen::MatrixXd to_dense(Matrix& matrix) {
  const auto local = matrix.getLocalMatrixHost();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(local.numRows(), local.numCols());
  for (LocalOrdinal row = 0; row < local.numRows(); ++row)
    for (auto n = local.graph.row_map(row); n < local.graph.row_map(row + 1); ++n) dense(row, local.graph.entries(n)) += local.values(n);
  return dense;
}

/// Unknowns, rates and shares of the velocity's weight, on one rank.
struct Arguments {
  Eigen::VectorXd unknowns, velocity, shares;
};

Eigen::VectorXd residual_of(Contribution& contribution, const HeatModel& model, const Eigen::VectorXd& unknowns, const Eigen::VectorXd& velocity) {
  const Vector x = to_vector(model.space->local_dofs(), unknowns), v = to_vector(model.space->local_dofs(), velocity);
  Configuration at{0.4, x, x};
  at.velocity = at.local_velocity = &v;
  Vector residual(model.space->dofs());
  std::optional<StepFailure> failure;
  contribution.add_residual(at, residual, failure);
  if (failure) throw *failure;
  return to_eigen(residual);
}

Eigen::MatrixXd jacobian_of(Contribution& contribution, const HeatModel& model, const Arguments& arguments, double by_velocity, double by_unknowns,
                            Eigen::VectorXd* residual = nullptr) {
  const Vector x = to_vector(model.space->local_dofs(), arguments.unknowns), v = to_vector(model.space->local_dofs(), arguments.velocity);
  const Vector shares = to_vector(model.space->local_dofs(), arguments.shares);
  Configuration at{0.4, x, x};
  at.velocity = at.local_velocity = &v;
  const JacobianWeights weights{0.0, by_velocity, by_unknowns, &shares};
  Matrix jacobian(model.space->graph());
  std::optional<StepFailure> failure;
  if (residual != nullptr) {
    Vector r(model.space->dofs());
    contribution.add_residual_and_jacobian(at, weights, r, jacobian, failure);
    *residual = to_eigen(r);
  } else {
    contribution.add_jacobian(at, weights, jacobian, failure);
  }
  if (failure) throw *failure;
  return to_dense(jacobian);
}

Eigen::MatrixXd differences(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f, const Eigen::VectorXd& x) {
  Eigen::MatrixXd J(f(x).size(), x.size());
  for (Eigen::Index n = 0; n < x.size(); ++n) {
    Eigen::VectorXd plus = x, minus = x;
    plus[n] += 1e-5;
    minus[n] -= 1e-5;
    J.col(n) = (f(plus) - f(minus)) / (plus[n] - minus[n]);
  }
  return J;
}

ThermalProperties nonlinear_properties(ConductivityActsIn acts_in) {
  ThermalProperties properties;
  properties.conductivity = of_temperature([](double theta) { return 2.0 + 0.3 * theta + 0.05 * theta * theta; });
  properties.specific_heat = of_temperature([](double theta) { return 1.5 + std::sin(theta); });
  properties.acts_in = acts_in;
  properties.source =
      function_of([](const std::vector<double>& at) { return (1.0 + at[0]) * (at[1] - 2.0 * at[2] + at[3]) * std::cos(at[4]) + 0.3; });
  return properties;
}

/// Checks J = omega dr/dx + beta dr/dv S.
void check(Contribution& contribution, const HeatModel& model, const Arguments& arguments, const std::string& what) {
  const double beta = contribution.uses().time_derivatives > 0 ? 3.0 : 0.0, omega = 0.6;
  Eigen::VectorXd together;
  const Eigen::MatrixXd J = jacobian_of(contribution, model, arguments, beta, omega, &together);
  const Eigen::VectorXd residual = residual_of(contribution, model, arguments.unknowns, arguments.velocity);
  Eigen::MatrixXd expected =
      omega * differences([&](const Eigen::VectorXd& x) { return residual_of(contribution, model, x, arguments.velocity); }, arguments.unknowns);
  if (beta != 0.0)
    expected += beta *
                differences([&](const Eigen::VectorXd& v) { return residual_of(contribution, model, arguments.unknowns, v); }, arguments.velocity) *
                arguments.shares.asDiagonal();
  EXPECT_GT(residual.cwiseAbs().maxCoeff(), 0.0) << what;
  EXPECT_LE((J - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff()) << what << ": " << contribution.name();
  EXPECT_LE((J - jacobian_of(contribution, model, arguments, beta, omega)).cwiseAbs().maxCoeff(), 0.0) << what;
  EXPECT_LE((together - residual).cwiseAbs().maxCoeff(), 1e-13 * residual.cwiseAbs().maxCoeff()) << what;
}

Arguments arguments_of(const HeatModel& model) {
  const auto wave = [](double a, double b, double c) { return [=](const Position& X) { return std::sin(a * X[0] + b * X[1] + c * X[2]); }; };
  const auto u = [&](const Position& X) -> Position { return {0.08 * wave(2, 1, 3)(X), 0.06 * wave(1, -3, 2)(X), 0.07 * wave(-1, 2, 2)(X)}; };
  const Vector x = model.unknowns([&](const Position& X) { return 2.0 + 0.8 * wave(3, 2, -1)(X); }, u);
  Arguments result{to_eigen(x), to_eigen(model.unknowns(wave(2, -1, 1), u)), {}};
  result.shares = 0.7 + 0.2 * Eigen::ArrayXd::LinSpaced(result.unknowns.size(), 0.0, 1.0);
  return result;
}

struct Case {
  CellShape shape;
  Kinematics kinematics;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const CellShape shape : cells_of(2))
    for (const Kinematics kinematics : {Kinematics::plane_strain, Kinematics::plane_stress, Kinematics::axisymmetric})
      cases.push_back({shape, kinematics});
  for (const CellShape shape : cells_of(3)) cases.push_back({shape, Kinematics::three_dimensional});
  return cases;
}

std::string name_of(const Case& of) { return std::to_string(topology(of.shape).nodes) + " nodes, " + to_string(of.kinematics); }

TEST(HeatJacobian, OfConductionIsTheDerivativeInAllConfigurations) {
  for (const Case& of : all_cases())
    for (const auto& [name, acts_in] : conductivity_names()) {
      HeatSetup setup{nonlinear_properties(acts_in), of.kinematics};
      setup.displacement = true;
      const HeatModel model(distorted_mesh(of.shape, 1, 0.15, true), setup);
      HeatConduction conduction(model.bodies);
      EXPECT_EQ(conduction.uses().reads.size(), acts_in == ConductivityActsIn::reference ? 1u : 2u);
      check(conduction, model, arguments_of(model), name_of(of) + ", " + name);
    }
}

TEST(HeatJacobian, WithoutDisplacementsConductionActsInTheReference) {
  for (const Case& of : all_cases()) {
    const HeatModel model(distorted_mesh(of.shape, 1, 0.15, true), {nonlinear_properties(ConductivityActsIn::current), of.kinematics});
    HeatConduction conduction(model.bodies);
    EXPECT_EQ(conduction.uses().reads, std::vector<std::string>{"temperature"});
    const Arguments arguments = arguments_of(model);
    check(conduction, model, arguments, name_of(of));
  }
}

TEST(HeatJacobian, OfCapacityAndSourcesIsTheDerivative) {
  for (const Case& of : all_cases())
    for (const bool lumped : {false, true}) {
      if (lumped && is_quadratic(of.shape)) continue;
      HeatSetup setup{nonlinear_properties(ConductivityActsIn::current), of.kinematics, 1.3};
      setup.displacement = true;
      setup.properties.lumped_capacity = lumped;
      const HeatModel model(distorted_mesh(of.shape, 1, 0.15, true), setup);
      HeatCapacity capacity(model.bodies);
      check(capacity, model, arguments_of(model), name_of(of) + (lumped ? ", lumped" : ""));
      HeatSource source(model.bodies);
      if (!lumped) check(source, model, arguments_of(model), name_of(of));
    }
}

TEST(HeatJacobian, OfLoadsIsTheDerivative) {
  for (const Case& of : all_cases()) {
    HeatSetup setup{nonlinear_properties(ConductivityActsIn::current), of.kinematics};
    setup.displacement = true;
    const HeatModel model(distorted_mesh(of.shape, 1, 0.15, true), setup);
    const std::string side = "body/surface";
    const ScalarFunction h = function_of([](const std::vector<double>& at) { return (2.0 + at[0] + at[2]) * std::exp(0.2 * at[4]); });
    const auto radiation = load_on<RadiationOptions>(model, side, [](RadiationOptions& options) {
      options.emissivity = 0.8;
      options.stefan_boltzmann = 0.03;
      options.surroundings = of_place([](const Position& X) { return 1.0 + X[0]; });
    });
    for (const auto& load :
         {convection(model, side, h, of_place([](const Position& X) { return 3.0 + X[1]; })), heat_flux(model, side, h), radiation})
      check(*load, model, arguments_of(model), name_of(of));
  }
}

}  // namespace
}  // namespace mortise
