#pragma once
// Contributions to the rows of heat that book what flows.

#include <memory>
#include <string>
#include <vector>

#include "model/contributions.hpp"
#include "mortise/thermal/heat_contributions.hpp"
#include "mortise/thermal/thermal_bodies.hpp"

namespace mortise {

/// Weights of the flows at the start of a step.
struct FlowsAtStart {
  double share = 0.0;        ///< s in (1 - s) f_(n+1) + s f_n
  bool is_of_system = true;  ///< the system weighs them; else the contribution does so itself, as of the trapezoidal rule in statics
};

/// A contribution f to the rows of heat, and the power that it takes from each body: the sums of its rows, as they are in balance over a step.
class BookedHeat : public CountedContribution {
 public:
  BookedHeat(std::string name, std::shared_ptr<Contribution> flow, std::shared_ptr<const ThermalBodies> bodies, const FlowsAtStart& at_start,
             const Timers& timers);
  Kind kind() const override;
  FieldUse uses() const override { return flow_->uses(); }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;
  void commit(const Configuration& at) override;
  void serialize(StateArchive& archive) override;

  /// The state from which the first step starts. Throws StepFailure on every rank. Collective.
  virtual void begin(const Configuration& at);

  /// Mean power over the last step [mesh bodies].
  const std::vector<double>& power() const { return power_; }
  /// Since the start [mesh bodies].
  const std::vector<double>& energy() const { return energy_; }

 protected:
  const ThermalBodies& bodies() const { return *bodies_; }
  Contribution& flow() const { return *flow_; }
  /// f at a configuration; by default that of the flow. Collective.
  virtual void add_flow(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure);
  double start_time() const { return time_; }

 private:
  RCP<Vector> flow_at(const Configuration& at, std::optional<StepFailure>& failure);
  /// Sums of rows of owned nodes over ranks, by bodies.
  std::vector<double> sums(const Vector& flow) const;

  std::shared_ptr<Contribution> flow_;
  std::shared_ptr<const ThermalBodies> bodies_;
  FlowsAtStart at_start_;
  double time_ = 0.0;                   ///< t_n
  RCP<Vector> before_;                  ///< f_n on the owned dofs; null: it has no weight
  std::vector<double> power_, energy_;  ///< [mesh bodies]
};

/// Heat that bodies store: rho c dtheta/dt with the rate (theta - theta_n) / (t - t_n), whatever integrates motion. Between two steps, at t_n, the
/// rate is that of the last one.
class StoredHeat final : public BookedHeat {
 public:
  StoredHeat(const std::shared_ptr<const ThermalBodies>& bodies, const Timers& timers);
  Kind kind() const override { return Kind::interaction; }
  FieldUse uses() const override { return {{"temperature"}, {"temperature"}, 0}; }
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>& failure) override;
  void commit(const Configuration& at) override;
  void serialize(StateArchive& archive) override;
  void begin(const Configuration& at) override;

 protected:
  void add_flow(const Configuration& at, Vector& residual, std::optional<StepFailure>& failure) override;

 private:
  StoredHeat(const std::shared_ptr<const ThermalBodies>& bodies, std::shared_ptr<HeatCapacity> capacity, const Timers& timers);
  /// 1 / (t - t_n); 0 between two steps.
  double per_time(const Configuration& at) const { return at.time > start_time() ? 1.0 / (at.time - start_time()) : 0.0; }
  /// Length of the step that ends at `at`; between two steps that of the last one.
  double time_step(const Configuration& at) const { return at.time > start_time() ? at.time - start_time() : last_step_; }
  RCP<const Vector> rate(const Configuration& at) const;
  void serialize_vector(StateArchive& archive, const std::string& name, Vector& local) const;

  std::shared_ptr<HeatCapacity> capacity_;
  double last_step_ = 0.0;
  RCP<Vector> last_;       ///< theta_n, on the local dofs
  RCP<Vector> last_rate_;  ///< likewise
};

}  // namespace mortise
