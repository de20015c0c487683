// Time integration: amplification matrices, orders, energy, damping at infinite frequency, restart, Jacobian.

#include "mortise/nonlinear/time_scheme.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "mortise/core/trilinos_versions.hpp"
#include "oscillators.hpp"
#include "stored_numbers.hpp"

namespace mortise {
namespace {

using test::Oscillators;
using Balance = TimeScheme::Balance;

/// (u, h v, h^2 a) of the end of a step from those of its start, for M a + K u = 0 in Chung and Hulbert's form:
/// M ((1 - alpha_m) a' + alpha_m a) + K ((1 - alpha_f) u' + alpha_f u) = 0 with Newmark's formulas.
Eigen::Matrix3d chung_hulbert(double rho, double omega_h) {
  const double alpha_m = (2.0 * rho - 1.0) / (rho + 1.0), alpha_f = rho / (rho + 1.0);
  const double gamma = 0.5 - alpha_m + alpha_f, beta = 0.25 * std::pow(1.0 - alpha_m + alpha_f, 2), w2 = omega_h * omega_h;
  Eigen::Matrix3d after, before;
  after << 1.0, 0.0, -beta, 0.0, 1.0, -gamma, (1.0 - alpha_f) * w2, 0.0, 1.0 - alpha_m;
  before << 1.0, 1.0, 0.5 - beta, 0.0, 1.0, 1.0 - gamma, -alpha_f * w2, 0.0, -alpha_m;
  return after.inverse() * before;
}

double radius(const Eigen::Matrix3d& matrix) { return matrix.eigenvalues().cwiseAbs().maxCoeff(); }

TEST(TimeScheme, StepsAreThoseOfChungAndHulbertsAmplificationMatrix) {
  for (const Balance balance : {Balance::over_step, Balance::at_end})
    for (const double rho : {0.0, 0.3, 0.8, 1.0})
      for (const double h : {0.05, 0.7, 40.0}) {
        const Oscillators oscillators(generalised_alpha(rho, balance), {});
        AcceptedState state = oscillators.start(0.5);
        const int steps = 4;
        state = oscillators.walk(state, steps * h, steps);
        for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*oscillators.dofs)); ++row) {
          const GlobalOrdinal dof = oscillators.dofs->getGlobalElement(row);
          const double omega2 = oscillators.stiffness(dof) / Oscillators::mass(dof);
          Eigen::Vector3d expected(1.0, 0.5 * h, -omega2 * h * h);
          double size = expected.norm();
          for (int n = 0; n < steps; ++n) size = std::max(size, (expected = chung_hulbert(rho, std::sqrt(omega2) * h) * expected).norm());
          EXPECT_NEAR(Oscillators::value(*state.x, row), expected[0], 1e-13 * size) << rho << " " << h;
          EXPECT_NEAR(h * Oscillators::value(*state.rates->velocity, row), expected[1], 1e-13 * size);
          EXPECT_NEAR(h * h * Oscillators::value(*state.rates->acceleration, row), expected[2], 1e-12 * size);
        }
      }
}

TEST(TimeScheme, TheSpectralRadiusAtInfiniteFrequencyIsTheOneAskedFor) {
  for (const double rho : {0.2, 0.5, 0.8, 0.95}) {
    const TimeScheme scheme = generalised_alpha(rho, Balance::at_end);
    EXPECT_NEAR(radius(chung_hulbert(rho, 1e6)), rho, 1e-4);
    EXPECT_NEAR(scheme.alpha_f, rho / (1.0 + rho), 1e-15);
  }
}

/// Error of (u, v) at the end of a damped, driven oscillation with the solution u = exp(-t/4) + sin(t).
double error_of(const TimeScheme& scheme, int steps) {
  Oscillators::Choices choices;
  choices.damping = 0.2;
  choices.dofs = 3;
  double error = 0.0;
  // The load of dof 0 alone has this solution.
  choices.load = [](double t) {
    const double u = std::exp(-0.25 * t) + std::sin(t), v = -0.25 * std::exp(-0.25 * t) + std::cos(t), a = std::exp(-0.25 * t) / 16.0 - std::sin(t);
    return a + 0.2 * v + u;
  };
  const Oscillators oscillators(scheme, choices);
  Vector x(oscillators.system->map()), v(oscillators.dofs);
  x.putScalar(1.0);
  v.putScalar(0.75);
  const AcceptedState end = oscillators.walk(oscillators.system->initial_state(x, v, false), 3.0, steps);
  if (oscillators.dofs->isNodeGlobalElement(0))
    error = std::hypot(Oscillators::value(*end.x, 0) - std::exp(-0.75) - std::sin(3.0),
                       Oscillators::value(*end.rates->velocity, 0) + 0.25 * std::exp(-0.75) - std::cos(3.0));
  double largest = 0.0;
  Teuchos::reduceAll(*oscillators.dofs->getComm(), Teuchos::REDUCE_MAX, error, Teuchos::outArg(largest));
  return largest;
}

TEST(TimeScheme, OrdersInTheStep) {
  const auto order = [](const TimeScheme& scheme) { return std::log2(error_of(scheme, 80) / error_of(scheme, 160)); };
  for (const Balance balance : {Balance::over_step, Balance::at_end})
    for (const double rho : {0.0, 0.8, 1.0}) EXPECT_NEAR(order(generalised_alpha(rho, balance)), 2.0, 0.1) << rho;
  EXPECT_NEAR(order(newmark(0.25, 0.5)), 2.0, 0.1);
  EXPECT_NEAR(order(newmark(0.49, 0.9)), 1.0, 0.15);
  EXPECT_NEAR(order(backward_euler()), 1.0, 0.15);
}

TEST(TimeScheme, TheMidpointRuleKeepsTheEnergyOfLinearOscillators) {
  const Oscillators oscillators(generalised_alpha(1.0, Balance::over_step), {});
  const auto energies = [&](const AcceptedState& state) {
    std::vector<double> result;
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*oscillators.dofs)); ++row) {
      const GlobalOrdinal dof = oscillators.dofs->getGlobalElement(row);
      const double u = Oscillators::value(*state.x, row), v = Oscillators::value(*state.rates->velocity, row);
      result.push_back(0.5 * Oscillators::mass(dof) * v * v + 0.5 * oscillators.stiffness(dof) * u * u);
    }
    return result;
  };
  const AcceptedState first = oscillators.start(0.5);
  const std::vector<double> before = energies(first), after = energies(oscillators.walk(first, 300.0, 1000));
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-11 * before[i]);
}

TEST(TimeScheme, TheJacobianIsTheDerivativeOfTheResidual) {
  Oscillators::Choices choices;
  choices.cubic = 0.7;
  choices.damping = 0.3;
  choices.load = [](double t) { return 1.0 + t; };
  if (Tpetra::getDefaultComm()->getRank() == 0) choices.massless = {0};
  for (const TimeScheme& scheme :
       {generalised_alpha(0.8, Balance::over_step), generalised_alpha(0.8, Balance::at_end), newmark(0.3025, 0.6), backward_euler()}) {
    const Oscillators oscillators(scheme, choices);
    const SemiSmoothSystem& system = *oscillators.system;
    AcceptedState state = oscillators.walk(oscillators.start(0.4), 0.3, 2);
    const StepContext context = system.step_from(state, 0.4);
    Vector x(*state.x, Teuchos::Copy), v(system.map()), Jv(system.map());
    x.putScalar(0.9);
    v.putScalar(1.0);
    system.linearise(system.evaluate(x, context)).apply(v, Jv);
    const double step = 1e-5;
    Vector plus(x, Teuchos::Copy), minus(x, Teuchos::Copy);
    plus.update(step, v, 1.0);
    minus.update(-step, v, 1.0);
    Vector difference(system.evaluate(plus, context).residual(), Teuchos::Copy);
    difference.update(-0.5 / step, system.evaluate(minus, context).residual(), 0.5 / step);
    const double size = Jv.normInf();
    difference.update(-1.0, Jv, 1.0);
    EXPECT_LE(difference.normInf(), 1e-8 * size);
  }
}

TEST(TimeScheme, ARestartGoesOnBitByBit) {
  Oscillators::Choices choices;
  choices.cubic = 0.7;
  choices.damping = 0.1;
  choices.load = [](double t) { return std::sin(3.0 * t); };
  for (const Balance balance : {Balance::over_step, Balance::at_end}) {
    const TimeScheme scheme = generalised_alpha(0.7, balance);
    const Oscillators whole(scheme, choices), second(scheme, choices);
    const AcceptedState middle = whole.walk(whole.start(0.4), 1.0, 8);
    test::StoredNumbers stored;
    whole.system->store(stored, middle);
    test::StoredNumbers memory(stored.numbers);
    const AcceptedState end = whole.walk(middle, 2.0, 8), restarted = second.walk(second.system->restore(memory), 2.0, 8);
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*whole.dofs)); ++row) {
      EXPECT_EQ(Oscillators::value(*end.x, row), Oscillators::value(*restarted.x, row));
      EXPECT_EQ(Oscillators::value(*end.rates->acceleration, row), Oscillators::value(*restarted.rates->acceleration, row));
    }
  }
}

TEST(TimeScheme, ASystemWithoutTimeRefusesWhatReadsRates) {
  SystemParts parts;
  Oscillators oscillators(backward_euler(), {});
  parts = oscillators.system->parts();
  parts.time = nullptr;
  EXPECT_THROW(SemiSmoothSystem(parts, Timers{}), std::invalid_argument);
}

}  // namespace
}  // namespace mortise
