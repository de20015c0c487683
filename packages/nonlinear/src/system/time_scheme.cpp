#include "mortise/nonlinear/time_scheme.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise {
namespace {

using Balance = TimeScheme::Balance;

/// coefficients[0] scale D + coefficients[1] of_velocity v_n + coefficients[2] of_acceleration a_n
RCP<Vector> rate(const TimeStep& step, const Vector& unknowns, const std::array<double, 3>& coefficients, double of_change, double of_velocity,
                 double of_acceleration) {
  const auto result = rcp(new Vector(unknowns.getMap()));
  result->update(of_change * coefficients[0], unknowns, -of_change * coefficients[0], *step.unknowns, 0.0);
  result->update(of_velocity * coefficients[1], *step.start.velocity, of_acceleration * coefficients[2], *step.start.acceleration, 1.0);
  return result;
}

/// v_j = D_j / h where there is no mass.
void put_mean_velocities(const TimeStep& step, const Vector& unknowns, Vector& velocity) {
  const auto now = unknowns.getLocalViewHost(Tpetra::Access::ReadOnly), before = step.unknowns->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto rows = velocity.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal dof : step.integration->massless) rows(dof, 0) = (now(dof, 0) - before(dof, 0)) / step.dt;
}

RCP<Vector> velocity_at_end(const TimeStep& step, const Vector& unknowns) {
  return rate(step, unknowns, step.integration->scheme.velocity, 1.0 / step.dt, 1.0, step.dt);
}

RCP<Vector> acceleration_at_end(const TimeStep& step, const Vector& unknowns) {
  return rate(step, unknowns, step.integration->scheme.acceleration, 1.0 / (step.dt * step.dt), 1.0 / step.dt, 1.0);
}

/// w_(n+1) from a_(n+1).
void balance_at_end(const TimeStep& step, Vector& acceleration) {
  const TimeScheme& scheme = step.integration->scheme;
  if (!scheme.has_balanced_acceleration()) return;
  const double share = 1.0 / (1.0 - scheme.alpha_f);
  acceleration.update(share * scheme.alpha_m, *step.start.acceleration, -share * scheme.alpha_f, *step.start.balanced_acceleration,
                      share * (1.0 - scheme.alpha_m));
}

}  // namespace

TimeScheme generalised_alpha(double spectral_radius, Balance balance) {
  const double rho = spectral_radius;
  const double alpha_m = (2.0 * rho - 1.0) / (rho + 1.0), alpha_f = rho / (rho + 1.0);
  const double beta = 0.25 * (1.0 - alpha_m + alpha_f) * (1.0 - alpha_m + alpha_f);
  TimeScheme scheme = newmark(beta, 0.5 - alpha_m + alpha_f);
  scheme.balance = balance;
  scheme.alpha_m = alpha_m;
  scheme.alpha_f = alpha_f;
  return scheme;
}

// u_(n+1) = u_n + h v_n + h^2 ((1/2 - beta) a_n + beta a_(n+1)),  v_(n+1) = v_n + h ((1 - gamma) a_n + gamma a_(n+1)).
TimeScheme newmark(double beta, double gamma) {
  TimeScheme scheme;
  scheme.balance = Balance::at_end;
  scheme.acceleration = {1.0 / beta, -1.0 / beta, 1.0 - 0.5 / beta};
  scheme.velocity = {gamma / beta, 1.0 - gamma / beta, 1.0 - 0.5 * gamma / beta};
  return scheme;
}

TimeScheme backward_euler() {
  TimeScheme scheme;
  scheme.balance = Balance::at_end;
  scheme.velocity = {1.0, 0.0, 0.0};
  scheme.acceleration = {1.0, -1.0, 0.0};
  return scheme;
}

JacobianWeights TimeStep::weights() const {
  const TimeScheme& scheme = integration->scheme;
  const bool over_step = scheme.balance == Balance::over_step;
  JacobianWeights weights;
  weights.acceleration = (1.0 - scheme.alpha_m) * scheme.acceleration[0] / (dt * dt) / (over_step ? 1.0 : 1.0 - scheme.alpha_f);
  weights.velocity = (over_step ? 1.0 - scheme.alpha_f : 1.0) * scheme.velocity[0] / dt;
  return weights;
}

BlendedRates blended_rates(const TimeStep& step, const Vector& unknowns) {
  const TimeScheme& scheme = step.integration->scheme;
  BlendedRates rates{velocity_at_end(step, unknowns), acceleration_at_end(step, unknowns)};
  if (scheme.balance == Balance::over_step) {
    rates.velocity->update(scheme.alpha_f, *step.start.velocity, 1.0 - scheme.alpha_f);
    rates.acceleration->update(scheme.alpha_m, *step.start.acceleration, 1.0 - scheme.alpha_m);
  } else {
    balance_at_end(step, *rates.acceleration);
  }
  put_mean_velocities(step, unknowns, *rates.velocity);
  return rates;
}

AcceptedRates rates_at_end(const TimeStep& step, const Vector& unknowns, const Vector& external_forces) {
  const TimeScheme& scheme = step.integration->scheme;
  const RCP<Vector> velocity = velocity_at_end(step, unknowns), acceleration = acceleration_at_end(step, unknowns);
  put_mean_velocities(step, unknowns, *velocity);
  AcceptedRates rates;
  if (scheme.has_balanced_acceleration()) {
    const auto balanced = rcp(new Vector(*acceleration, Teuchos::Copy));
    balance_at_end(step, *balanced);
    rates.balanced_acceleration = balanced;
  }
  rates.velocity = velocity;
  rates.acceleration = acceleration;
  if (scheme.blends_forces()) rates.external_forces = rcp(new Vector(external_forces, Teuchos::Copy));
  return rates;
}

RCP<Vector> predicted_unknowns(const TimeStep& step) {
  const auto result = rcp(new Vector(*step.unknowns, Teuchos::Copy));
  Vector change(result->getMap());
  change.update(step.dt, *step.start.velocity, 0.5 * step.dt * step.dt, *step.start.acceleration, 0.0);
  if (step.integration->extension.is_null())
    result->update(1.0, change, 1.0);
  else
    step.integration->extension->apply(change, *result, Teuchos::NO_TRANS, 1.0, 1.0);
  return result;
}

RCP<Vector> velocity_shares(const TimeStep& step) {
  const auto shares = rcp(new Vector(step.unknowns->getMap()));
  shares->putScalar(1.0);
  const auto rows = shares->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal dof : step.integration->massless) rows(dof, 0) = 1.0 / (step.dt * step.weights().velocity);
  return shares;
}

}  // namespace mortise
