#pragma once
// Conduction, capacity and sources of heat in bodies, as contributions to the residual.

#include <memory>
#include <string>
#include <vector>

#include "mortise/nonlinear/contribution.hpp"
#include "mortise/thermal/thermal_bodies.hpp"

namespace mortise {

/// Conduction: r_a = -integral of Grad N_a . Q dV0, Q as ConductivityActsIn says. Where Q depends on F, it reads displacements too, and the Jacobian
/// has their columns. Failures: a conductivity that is negative or not finite (kind input), det F <= 0 (kind inverted_element).
class HeatConduction final : public Contribution {
 public:
  explicit HeatConduction(std::shared_ptr<const ThermalBodies> bodies) : bodies_(std::move(bodies)) {}
  std::string name() const override { return "heat conduction"; }
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override;
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;
  void add_residual_and_jacobian(const Configuration& at, const JacobianWeights& weights, Vector& residual, Matrix& jacobian,
                                 std::optional<StepFailure>& failure) override;

 private:
  std::shared_ptr<const ThermalBodies> bodies_;
};

/// Capacity: r_a = integral of N_a rho0 c dtheta/dt dV0, or lumped, r_a = m_a c(theta_a) dtheta_a/dt with m_a = integral of N_a rho0 dV0. For systems
/// with time derivatives, and bodies with ThermalBodies::has_capacity(). Failures: a specific heat that is not above 0 and finite (kind input).
class HeatCapacity final : public Contribution {
 public:
  explicit HeatCapacity(std::shared_ptr<const ThermalBodies> bodies);
  /// Rates are changes over a step of this length from now on: a c that depends on the temperature then has its mean between both ends of the step, so
  /// that heat that is stored depends on the temperatures alone. 0: they are rates at a time.
  void set_time_step(double time_step) { time_step_ = time_step; }
  std::string name() const override { return "heat capacity"; }
  Kind kind() const override { return Kind::internal; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 1}; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

 private:
  std::shared_ptr<const ThermalBodies> bodies_;
  double time_step_ = 0.0;
  std::vector<double> ones_;  ///< [local dofs] shares of the velocity's weight where there are none
};

/// Sources: r_a = -integral of N_a R dV0, of bodies that have one. Failures: a source that is not finite (kind input).
class HeatSource final : public Contribution {
 public:
  explicit HeatSource(std::shared_ptr<const ThermalBodies> bodies) : bodies_(std::move(bodies)) {}
  std::string name() const override { return "heat source"; }
  Kind kind() const override { return Kind::external; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 0}; }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;

 private:
  std::shared_ptr<const ThermalBodies> bodies_;
};

/// Sum of a contribution's rows of heat over the owned nodes of each body of the mesh [power]. Summed over ranks that is, of HeatCapacity, the rate
/// of heat that the body stores; of a load or a source, minus its power; of HeatConduction, 0 up to round-off.
std::vector<double> sums_of_heat(Contribution& contribution, const ThermalBodies& bodies, const Configuration& at,
                                 std::optional<StepFailure>& failure);

}  // namespace mortise
