// Orders of convergence of temperatures in L2, against exact solutions: 2 of linear cells, 3 of quadratic ones.

#include <gtest/gtest.h>

#include "heat_model.hpp"
#include "mortise/solid/element_loop.hpp"

namespace mortise {
namespace {

using namespace test;

/// Integral of (theta_h - theta)^2 over an element. An integrand, see ElementLoop.
template <class OfCells>
struct SquaredError {
  using Geometry = OfCells;
  static constexpr int nodes = Geometry::nodes, components = 1, point_count = Geometry::mass_points;
  using Reads = std::tuple<FieldValue<1>>;
  using Residual = std::array<double, nodes>;

  const Field& exact;

  template <class Points, class Sums>
  void add(const Points& points, Sums& sums) const {
    for (int q = 0; q < point_count; ++q) {
      const auto at = points[q];
      Position X{};
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < Geometry::dimension; ++i) X[i] += at.N[a] * points.positions()[a][i];
      const double error = std::get<0>(at.fields).value[0] - exact(X);
      for (int a = 0; a < nodes; ++a) sums.residual[a] += at.weight * at.N[a] * error * error;
    }
  }
};

/// |theta_h - theta| in L2 on one rank.
double error_in_L2(const HeatModel& model, const Vector& unknowns, const Field& exact) {
  std::vector<double> squares(model.mesh->local_count(), 0.0);
  const auto values = unknowns.getLocalViewHost(Tpetra::Access::ReadOnly);
  visit_cell(model.mesh->blocks[0].shape, [&](auto cell) {
    using Cell = decltype(cell);
    if constexpr (Cell::dimension > 1) {
      using Integrand = SquaredError<ElementGeometry<Cell>>;
      const ElementLoop<Cell> loop(*model.space, model.mesh->blocks[0]);
      loop.template add<true, false>(BlockIntegral<Integrand>(Integrand{exact}, model.mesh->blocks[0], 1.0),
                                     typename ElementLoop<Cell>::template Fields<1>{{{values.data(), model.space->rows(0)}}},
                                     AssemblyTarget{{squares.data(), model.space->rows(0)}});
    }
  });
  double sum = 0.0;
  for (const double square : squares) sum += square;
  return std::sqrt(sum);
}

/// Between meshes of n and 2 n cells along each side.
double order_of(const std::function<double(int)>& error, int n) { return std::log2(error(n) / error(2 * n)); }

// theta = sin(2 x) cosh(y) e^(-z/2) / 20 with k = 1 + theta/2 and R = -(k lap theta + k' |grad theta|^2), lap theta = (-4 + 1 + 1/4) theta in 3D.
TEST(HeatConvergence, OfAManufacturedSolutionWithAConductivityThatDependsOnTheTemperature) {
  for (const int dimension : {2, 3})
    for (const CellShape shape : cells_of(dimension)) {
      const bool in_space = dimension == 3;
      const auto parts = [=](const Position& X) -> std::array<double, 4> {
        const double factor = 0.05 * (in_space ? std::exp(-0.5 * X[2]) : 1.0), s = std::sin(2.0 * X[0]), c = std::cos(2.0 * X[0]);
        const double theta = factor * s * std::cosh(X[1]);
        return {theta, 2.0 * factor * c * std::cosh(X[1]), factor * s * std::sinh(X[1]), in_space ? -0.5 * theta : 0.0};
      };
      const Field exact = [&](const Position& X) { return parts(X)[0]; };
      HeatSetup setup;
      setup.thickness = 1.0;
      setup.kinematics = in_space ? Kinematics::three_dimensional : Kinematics::plane_strain;
      setup.properties.conductivity = of_temperature([](double theta) { return 1.0 + 0.5 * theta; });
      setup.properties.source = of_place([&](const Position& X) {
        const auto [theta, x, y, z] = parts(X);
        return -((1.0 + 0.5 * theta) * (in_space ? -2.75 : -3.0) * theta + 0.5 * (x * x + y * y + z * z));
      });
      const auto error = [&](int cells) {
        const HeatModel model(distorted_mesh(shape, cells, 0.1), setup);
        const SteadyHeat solved = solve_steady(model, {std::make_shared<HeatConduction>(model.bodies), std::make_shared<HeatSource>(model.bodies)},
                                               {prescribe("body/surface", of_place(exact))}, 0.1);
        return error_in_L2(model, solved.unknowns, exact);
      };
      const bool quadratic = is_quadratic(shape);
      const double order = order_of(error, in_space ? (quadratic ? 3 : 5) : 8);
      EXPECT_NEAR(order, quadratic ? 3.0 : 2.0, 0.15) << topology(shape).nodes << " nodes";
      RecordProperty("order_" + std::to_string(topology(shape).nodes), std::to_string(order));
    }
}

// A ring between radii 1 and 2 with prescribed temperatures: theta = ln r / ln 2.
TEST(HeatConvergence, OfTheLogarithmicProfileOfARing) {
  const Field exact = [](const Position& X) { return std::log(X[0]) / std::log(2.0); };
  for (const CellShape shape : cells_of(2)) {
    HeatSetup setup;
    setup.kinematics = Kinematics::axisymmetric;
    setup.properties.conductivity = 4.0;
    double power = 0.0;
    const auto error = [&](int cells) {
      const HeatModel model(make_lattice_mesh(
                                self(), shape, {cells, 2, 1},
                                [](const Position& s) -> Position {
                                  return {1.0 + s[0], 0.5 * s[1], 0.0};
                                },
                                false),
                            setup);
      const SteadyHeat solved =
          solve_steady(model, {std::make_shared<HeatConduction>(model.bodies)}, {prescribe("body/left", 0.0), prescribe("body/right", 1.0)}, 1.0);
      const auto forces = solved.forces.getLocalViewHost(Tpetra::Access::ReadOnly);
      power = 0.0;
      for (const LocalOrdinal node : model.mesh->node_sets.at("body/right")) power += forces(node, 0);
      return error_in_L2(model, solved.unknowns, exact);
    };
    const bool quadratic = is_quadratic(shape);
    EXPECT_NEAR(order_of(error, 16), quadratic ? 3.0 : 2.0, 0.15) << topology(shape).nodes << " nodes";
    // 2 pi k H / ln(b/a), which energies have with the square of the error of gradients: (h/r)^2 / 12 or its square.
    const double expected = 2.0 * EIGEN_PI * 4.0 * 0.5 / std::log(2.0), h = 1.0 / 32.0;
    EXPECT_NEAR(power, expected, expected * (quadratic ? h * h * h * h : h * h)) << topology(shape).nodes << " nodes";
  }
}

}  // namespace
}  // namespace mortise
