#pragma once
// Oscillators that are not coupled: a mass, a spring with a cubic part, a dashpot and a load for each dof.

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <functional>
#include <memory>

#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "mortise/nonlinear/linear_solver_options.hpp"
#include "mortise/nonlinear/load_stepper.hpp"

namespace mortise::test {

/// A force at each dof as a function of its rates and the time, with its derivatives (displacement, velocity, acceleration).
class DofForce final : public Contribution {
 public:
  struct State {
    GlobalOrdinal dof;
    double u, v, a, t;
  };
  struct Response {
    double force, by_displacement, by_velocity, by_acceleration;
  };
  DofForce(std::string name, Kind kind, int derivatives, std::function<Response(const State&)> law)
      : name_(std::move(name)), kind_(kind), derivatives_(derivatives), law_(std::move(law)) {}
  std::string name() const override { return name_; }
  Kind kind() const override { return kind_; }
  FieldUse uses() const override {
    FieldUse uses;
    uses.time_derivatives = derivatives_;
    return uses;
  }
  void add_residual(const Configuration& at, Vector& residual, std::optional<StepFailure>&) override {
    const auto rows = residual.getLocalViewHost(Tpetra::Access::ReadWrite);
    for (std::size_t i = 0; i < rows.extent(0); ++i) rows(i, 0) += response(at, i).force;
  }
  void add_jacobian(const Configuration& at, const JacobianWeights& weights, Matrix& jacobian, std::optional<StepFailure>&) override {
    for (std::size_t i = 0; i < at.unknowns.getLocalLength(); ++i) {
      const Response of = response(at, i);
      const double share = weights.local_velocity_shares != nullptr ? value(*weights.local_velocity_shares, i) : 1.0;
      const double entry =
          weights.unknowns * of.by_displacement + share * weights.velocity * of.by_velocity + weights.acceleration * of.by_acceleration;
      const auto column = static_cast<LocalOrdinal>(i);
      jacobian.sumIntoLocalValues(column, 1, &entry, &column);
    }
  }

 private:
  static double value(const Vector& v, std::size_t i) { return v.getLocalViewHost(Tpetra::Access::ReadOnly)(i, 0); }
  Response response(const Configuration& at, std::size_t i) const {
    return law_({at.unknowns.getMap()->getGlobalElement(static_cast<LocalOrdinal>(i)), value(at.unknowns, i),
                 at.velocity != nullptr ? value(*at.velocity, i) : 0.0, at.acceleration != nullptr ? value(*at.acceleration, i) : 0.0, at.time});
  }
  std::string name_;
  Kind kind_;
  int derivatives_;
  std::function<Response(const State&)> law_;
};

/// Masses 1 + i/8, springs k (1 + i) u + cubic u^3, dashpots c v, loads f(t) for dofs i = 0, 1, ...
struct Oscillators {
  struct Choices {
    double stiffness = 1.0, cubic = 0.0, damping = 0.0;
    std::function<double(double t)> load;
    GlobalOrdinal dofs = 5;
    std::vector<LocalOrdinal> massless;  ///< owned
  };
  static double mass(GlobalOrdinal dof) { return 1.0 + 0.125 * static_cast<double>(dof); }
  double stiffness(GlobalOrdinal dof) const { return choices.stiffness * (1.0 + static_cast<double>(dof)); }

  Oscillators(const TimeScheme& scheme, const Choices& of) : choices(of) {
    const auto comm = Tpetra::getDefaultComm();
    dofs = rcp(new Map(choices.dofs, 0, comm));
    const auto graph = rcp(new Graph(dofs, 1));
    for (const GlobalOrdinal dof : local_ids(*dofs)) graph->insertGlobalIndices(dof, 1, &dof);
    graph->fillComplete();
    SystemParts parts;
    parts.dofs = parts.local_dofs = dofs;
    parts.bulk_graph = [graph]() -> RCP<const Graph> { return graph; };
    using Kind = Contribution::Kind;
    using State = DofForce::State;
    using Response = DofForce::Response;
    parts.contributions.push_back(std::make_shared<DofForce>("springs", Kind::internal, 0, [this](const State& s) {
      return Response{stiffness(s.dof) * s.u + choices.cubic * s.u * s.u * s.u, stiffness(s.dof) + 3.0 * choices.cubic * s.u * s.u, 0.0, 0.0};
    }));
    if (choices.load)
      parts.contributions.push_back(std::make_shared<DofForce>("loads", Kind::external, 0, [this](const State& s) {
        return Response{-choices.load(s.t), 0.0, 0.0, 0.0};
      }));
    parts.contributions.push_back(std::make_shared<DofForce>("inertia", Kind::internal, 2, [this](const State& s) {
      if (is_massless(s.dof)) return Response{choices.damping * s.v, 0.0, choices.damping, 0.0};
      return Response{mass(s.dof) * s.a + choices.damping * s.v, 0.0, choices.damping, mass(s.dof)};
    }));
    LinearSolverOptions solver;
    solver.kind.value = LinearSolverOptions::Kind::mumps;
    parts.linear_solver = make_linear_solver(solver, comm, timers);
    parts.time = std::make_shared<TimeIntegration>(TimeIntegration{scheme, choices.massless, Teuchos::null});
    system = std::make_unique<SemiSmoothSystem>(std::move(parts), timers);
  }
  bool is_massless(GlobalOrdinal dof) const {
    const LocalOrdinal row = dofs->getLocalElement(dof);
    return std::find(choices.massless.begin(), choices.massless.end(), row) != choices.massless.end();
  }
  /// u = 1, v = velocity.
  AcceptedState start(double velocity) const {
    Vector x(system->map()), v(dofs);
    x.putScalar(1.0);
    v.putScalar(velocity);
    return system->initial_state(x, v, false);
  }
  /// Steps of the same length up to `end`.
  AcceptedState walk(AcceptedState state, double end, int steps) const {
    SteppingOptions stepping;
    stepping.end_time = end;
    stepping.step = (end - state.context.time) / steps;
    SteppingState at(std::move(state));
    std::optional<StepFailure> failure;
    NewtonOptions newton;
    newton.momentum_tolerance = 1e-14;
    newton.increment_tolerance = 1e-13;
    run_steps(*system, stepping, newton, at, {}, {}, failure);
    if (failure) throw *failure;
    return at.accepted;
  }
  static double value(const Vector& v, LocalOrdinal row) { return v.getLocalViewHost(Tpetra::Access::ReadOnly)(row, 0); }

  Timers timers;
  Choices choices;
  RCP<const Map> dofs;
  std::unique_ptr<SemiSmoothSystem> system;
};

}  // namespace mortise::test
