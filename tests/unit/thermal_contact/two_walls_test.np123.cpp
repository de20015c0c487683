// Steady heat through two bodies in contact against exact solutions.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "mortise/core/over_ranks.hpp"
#include "two_bodies.hpp"

namespace mortise {
namespace {

using namespace test;

constexpr double free_value = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = 3.14159265358979323846;

std::shared_ptr<const ConductanceLaw> constant(double h) {
  const auto law = std::make_shared<ConstantConductance>();
  law->value = h;
  return law;
}

/// Turned by 30 degrees about the origin, in the plane of the first and the last direction.
Point turned(const Point& x, int dimension) {
  const double c = std::cos(pi / 6.0), s = std::sin(pi / 6.0);
  Point result = x;
  result[0] = c * x[0] - s * x[dimension - 1];
  result[dimension - 1] = s * x[0] + c * x[dimension - 1];
  return result;
}
Point back(const Point& x, int dimension) {
  const double c = std::cos(pi / 6.0), s = std::sin(pi / 6.0);
  Point result = x;
  result[0] = c * x[0] + s * x[dimension - 1];
  result[dimension - 1] = -s * x[0] + c * x[dimension - 1];
  return result;
}

/// Normal of the slave's face, which lies along the first axis before the turn; z is a pressure.
Point pressing(const TwoBodies& bodies, double pressure) {
  Point normal{};
  normal[bodies.dimension - 1] = bodies.slave == 0 ? pressure : -pressure;
  return turned(normal, bodies.dimension);
}

/// int of the functions of a uniform grid of `cells` on [0, 1] over [from, to].
std::vector<double> integrals(int cells, double from, double to) {
  std::vector<double> result(cells + 1, 0.0);
  const double h = 1.0 / cells;
  for (int cell = 0; cell < cells; ++cell) {
    const double a = std::max(from, h * cell), b = std::min(to, h * (cell + 1));
    if (b <= a) continue;
    const double share = ((a + b) / 2.0 - h * cell) / h;
    result[cell] += (b - a) * (1.0 - share);
    result[cell + 1] += (b - a) * share;
  }
  return result;
}

// A flux through an inclined flat interface whose meshes do not match. The lower body is wider than the upper one; where it is not covered the flux
// comes from outside. Both are linear across, with the jump q / h between them: elements have that exactly.
TEST(HeatThroughAnInclinedInterface, IsUniform) {
  const double k_lower = 15.0, k_upper = 40.0, L_lower = 0.7, L_upper = 1.2, h = 3.0, q = 5.0, wide = 2.0, from = 0.3, to = 1.75;
  for (const int dimension : {2, 3})
    for (const int slave : {0, 1}) {
      SCOPED_TRACE(testing::Message() << dimension << "D, slave " << slave);
      const int up = dimension - 1;
      GridBody lower, upper;
      lower.cells = upper.cells = {2, 2, 2};
      lower.cells[0] = 7;
      upper.cells[0] = 4;
      if (dimension == 3) {
        lower.cells[1] = 2;
        upper.cells[1] = 3;
      }
      lower.place = [&](const Point& u) {
        Point x = u;
        x[0] = wide * u[0];
        x[up] = L_lower * (u[up] - 1.0);
        return turned(x, dimension);
      };
      upper.place = [&](const Point& u) {
        Point x = u;
        x[0] = from + (to - from) * u[0];
        x[up] = L_upper * u[up];
        return turned(x, dimension);
      };
      lower.conductivity = k_lower;
      upper.conductivity = k_upper;
      const TwoBodies bodies(dimension, {lower, upper}, slave, {}, 100.0);
      // The flux q goes down; theta = 0 at y = 0 in the lower body.
      const auto exact = [&](std::size_t node) {
        const double y = back(bodies.points[node], dimension)[up];
        return bodies.body_of[node] == 0 ? q * y / k_lower : q / h + q * y / k_upper;
      };
      std::vector<double> prescribed(bodies.points.size(), free_value), load(bodies.points.size(), 0.0);
      const std::vector<double> before = integrals(lower.cells[0], 0.0, from / wide), behind = integrals(lower.cells[0], to / wide, 1.0),
                                across = dimension == 3 ? integrals(lower.cells[1], 0.0, 1.0) : std::vector<double>{1.0};
      for (std::size_t n = 0; n < bodies.points.size(); ++n) {
        if (bodies.is_far(static_cast<GlobalOrdinal>(n))) prescribed[n] = exact(n);
        if (bodies.body_of[n] != 0 || !bodies.is_on_face(static_cast<GlobalOrdinal>(n))) continue;
        const auto i = static_cast<std::size_t>(std::lround(bodies.units[n][0] * lower.cells[0]));
        const auto j = dimension == 3 ? static_cast<std::size_t>(std::lround(bodies.units[n][1] * lower.cells[1])) : 0;
        load[n] = q * wide * (before[i] + behind[i]) * across[j];
      }
      const SteadyHeat solved = solve_steady_heat(bodies, {0, constant(h), {}, {}}, prescribed, load, pressing(bodies, 2.0));
      for (std::size_t n = 0; n < bodies.points.size(); ++n) EXPECT_NEAR(solved.temperatures[n], exact(n), 1e-11 * q / h) << n;
      const double sign = slave == 1 ? 1.0 : -1.0;  // out of the slave
      for (const NodeHeat& node : solved.nodes) EXPECT_NEAR(node.flux, sign * q, 1e-11 * q);
      EXPECT_NEAR(solved.flow.conducted, sign * q * (to - from), 1e-11 * q);
    }
}

// Two layers under a pressure: q = dtheta / (L_1 / k_1 + 1 / h(p) + L_2 / k_2), for each law of the pressure.
TEST(HeatThroughTwoLayers, IsThatOfResistancesInSeries) {
  const double k_lower = 15.0, k_upper = 40.0, L_lower = 7.0, L_upper = 12.0, p = 2.5, difference = 90.0;
  const auto power = std::make_shared<PowerConductance>();
  power->factor = 8.0;
  power->hardness = 10.0;
  power->without_pressure = 0.5;
  const auto table = std::make_shared<TabulatedConductance>();
  table->pressures = {0.0, 2.0, 4.0};
  table->conductances = {1.0, 2.0, 6.0};
  const auto function = std::make_shared<ConductanceFunction>();
  function->conductance = ScalarFunction([](const std::vector<double>& of) { return 1.0 + of[0] * of[0]; }, "1 + pressure^2");
  const std::vector<std::pair<std::shared_ptr<const ConductanceLaw>, double>> laws = {
      {constant(3.0), 3.0}, {power, 0.5 + 8.0 * std::pow(p / 10.0, 0.95)}, {table, 3.0}, {function, 1.0 + p * p}};
  for (const auto& [law, h] : laws) {
    GridBody lower, upper;
    lower.cells = {5, 3, 1};
    upper.cells = {3, 4, 1};
    lower.place = [&](const Point& u) { return turned({3.0 * u[0], L_lower * (u[1] - 1.0), 0.0}, 2); };
    upper.place = [&](const Point& u) { return turned({3.0 * u[0], L_upper * u[1], 0.0}, 2); };
    lower.conductivity = k_lower;
    upper.conductivity = k_upper;
    const TwoBodies bodies(2, {lower, upper}, 1, {}, 100.0);
    std::vector<double> prescribed(bodies.points.size(), free_value);
    for (std::size_t n = 0; n < prescribed.size(); ++n)
      if (bodies.is_far(static_cast<GlobalOrdinal>(n))) prescribed[n] = bodies.body_of[n] == 0 ? 0.0 : difference;
    const SteadyHeat solved =
        solve_steady_heat(bodies, {0, law, {}, {}}, prescribed, std::vector<double>(prescribed.size(), 0.0), pressing(bodies, p));
    const double q = difference / (L_lower / k_lower + 1.0 / h + L_upper / k_upper);
    EXPECT_NEAR(solved.flow.conducted, 3.0 * q, 1e-10 * q);
  }
}

// On [0, 1] with insulated sides, y = 0 the interface, h its conductance:
//   above   theta = cos(pi x) (cosh(pi y) / h + sinh(pi y) / (pi k_1)),   below   theta = cos(pi x) sinh(pi y) / (pi k_2),   q = cos(pi x).
TEST(HeatThatVariesAlongTheInterface, ConvergesInSecondOrder) {
  const double k_lower = 2.0, k_upper = 5.0;
  for (const double h : {1.0, 1e2, 1e4, 1e6})
    for (const int slave : {0, 1}) {
      std::vector<double> errors, fluxes;
      for (const int n : {1, 2, 4}) {
        GridBody lower, upper;
        lower.cells = {7 * n, 5 * n, 1};
        upper.cells = {5 * n, 4 * n, 1};
        lower.place = [&](const Point& u) { return turned({u[0], u[1] - 1.0, 0.0}, 2); };
        upper.place = [&](const Point& u) { return turned({u[0], u[1], 0.0}, 2); };
        lower.conductivity = k_lower;
        upper.conductivity = k_upper;
        const TwoBodies bodies(2, {lower, upper}, slave, {}, 100.0);
        const auto exact = [&](std::size_t node) {
          const Point x = back(bodies.points[node], 2);
          const double s = std::sinh(pi * x[1]);
          return std::cos(pi * x[0]) * (bodies.body_of[node] == 0 ? s / (pi * k_lower) : std::cosh(pi * x[1]) / h + s / (pi * k_upper));
        };
        std::vector<double> prescribed(bodies.points.size(), free_value);
        for (std::size_t node = 0; node < prescribed.size(); ++node)
          if (bodies.is_far(static_cast<GlobalOrdinal>(node))) prescribed[node] = exact(node);
        const SteadyHeat solved =
            solve_steady_heat(bodies, {0, constant(h), {}, {}}, prescribed, std::vector<double>(prescribed.size(), 0.0), pressing(bodies, 1.0));
        double sum = 0.0;
        for (std::size_t node = 0; node < prescribed.size(); ++node) sum += std::pow(solved.temperatures[node] - exact(node), 2);
        errors.push_back(std::sqrt(sum / static_cast<double>(prescribed.size())));
        double of_flux = 0.0;
        for (const NodeHeat& node : solved.nodes)
          of_flux += node.weight * std::pow(node.flux - (slave == 1 ? 1.0 : -1.0) * std::cos(pi * back(bodies.points[node.node], 2)[0]), 2);
        fluxes.push_back(std::sqrt(sum_over_ranks(*bodies.comm, of_flux)));
      }
      SCOPED_TRACE(testing::Message() << "h " << h << ", slave " << slave);
      // Where h is small fluxes are h times a jump of temperatures, and of their order. As h grows they tend to multipliers, which lose half an order
      // in L2 against the dual norm of traces, by the inverse inequality.
      const double of_temperatures = std::log2(errors[1] / errors[2]), of_fluxes = std::log2(fluxes[1] / fluxes[2]);
      if (Tpetra::getDefaultComm()->getRank() == 0)
        std::printf("h %g, slave %d: order of temperatures %.2f, of fluxes at nodes %.2f\n", h, slave, of_temperatures, of_fluxes);
      EXPECT_NEAR(of_temperatures, 2.0, 0.2);
      EXPECT_GT(of_fluxes, h == 1.0 ? 1.8 : 1.5);
    }
}

// Nothing but a gap between the bodies, of a medium.
TEST(HeatAcrossAGap, IsThatOfTheMedium) {
  const double gap = 0.05, k_medium = 0.4, rough = 0.01, k = 3.0;
  const auto medium = std::make_shared<MediumConductance>();
  medium->conductivity = k_medium;
  medium->distance = rough;
  GridBody lower, upper;
  lower.cells = {5, 2, 1};
  upper.cells = {3, 2, 1};
  lower.place = [&](const Point& u) { return turned({u[0], u[1] - 1.0, 0.0}, 2); };
  upper.place = [&](const Point& u) { return turned({u[0], u[1] + gap, 0.0}, 2); };
  lower.conductivity = upper.conductivity = k;
  ContactOptions options;
  options.mortar.search_reach = 0.2;
  const TwoBodies bodies(2, {lower, upper}, 1, options, 100.0);
  std::vector<double> prescribed(bodies.points.size(), free_value);
  for (std::size_t n = 0; n < prescribed.size(); ++n)
    if (bodies.is_far(static_cast<GlobalOrdinal>(n))) prescribed[n] = bodies.body_of[n] == 0 ? 0.0 : 10.0;
  const std::vector<double> no_load(prescribed.size(), 0.0);
  const SteadyHeat solved = solve_steady_heat(bodies, {0, constant(k_medium / rough), medium, {}}, prescribed, no_load, {});
  EXPECT_NEAR(solved.flow.conducted, 10.0 / (2.0 / k + (gap + rough) / k_medium), 1e-10);
  // Laws that do not join at p = 0, g = 0 are refused.
  EXPECT_THROW(solve_steady_heat(bodies, {0, constant(1.02 * k_medium / rough), medium, {}}, prescribed, no_load, {}), InputError);
  EXPECT_THROW(solve_steady_heat(bodies, {0, {}, medium, {}}, prescribed, no_load, {}), InputError);
  // Without a law for gaps nothing flows.
  EXPECT_EQ(solve_steady_heat(bodies, {0, constant(3.0), {}, {}}, prescribed, no_load, {}).flow.conducted, 0.0);
}

}  // namespace
}  // namespace mortise
