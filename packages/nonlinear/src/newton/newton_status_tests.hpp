#pragma once
// When NOX is done, and when it gives up: one status test for each block of the residual, and those that end a solve.

#include <NOX_StatusTest_Generic.H>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mortise/nonlinear/cycle_detector.hpp"
#include "mortise/nonlinear/newton_solver.hpp"

namespace mortise::detail {

/// The iterates of one solve as the tests and the report see them.
class NewtonHistory {
 public:
  explicit NewtonHistory(NewtonReport& report);
  /// The solver's current iterate, entered if it is new. NOX may skip a test, so every test asks.
  const std::vector<NewtonIteration>& update(const NOX::Solver::Generic& solver);

 private:
  NewtonReport& report_;
  double last_time_;
};

/// A test that is a function of the iterates up to the current one.
class IterateTest : public NOX::StatusTest::Generic {
 public:
  using Iterates = std::vector<NewtonIteration>;
  IterateTest(NewtonHistory& history, std::string name) : history_(history), name_(std::move(name)) {}

  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic& solver, NOX::StatusTest::CheckType type) override;
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& stream, int indent = 0) const override;

 protected:
  virtual NOX::StatusTest::StatusType check(const Iterates& iterates) = 0;

 private:
  NewtonHistory& history_;
  std::string name_;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

/// Condition on the last iterate if it is a solution.
struct ConvergenceCriterion {
  std::string name;  ///< with the tolerance, for messages
  std::function<bool(const IterateTest::Iterates&)> met;
  std::function<std::string(const NewtonIteration&)> value;
};

/// All of them: momentum, prescribed displacements, gap, complementarity, increment, states of the nodes. Those of the residual are met as well where
/// integrals of contact jump: four whole corrections in a row are negligible, and no state changes. The residual is below 100 times the tolerances,
/// and no longer falls. The criterion of states is met where no node has another
/// state than the iterate was computed with. It is also met where states change without an effect. Then the last two iterates meet all other
/// criteria, and between them no displacement changes by more than 1e-3 of the tolerance. F is continuous across a change of state, so both are
/// solutions. Round-off decides on the state of a node on the border between two.
/// @param length size of the model
std::vector<ConvergenceCriterion> convergence_criteria(const NewtonOptions& options, double length);

/// NOX's view on one criterion.
class ConvergenceTest : public IterateTest {
 public:
  ConvergenceTest(NewtonHistory& history, ConvergenceCriterion criterion) : IterateTest(history, criterion.name), criterion_(std::move(criterion)) {}

 protected:
  NOX::StatusTest::StatusType check(const Iterates& iterates) override;

 private:
  ConvergenceCriterion criterion_;
};

/// Why a solve is given up at its last iterate, or nothing. `stiffness`: the system's scale s.
std::optional<StepFailure> reason_to_give_up(const std::vector<NewtonIteration>& iterates, const NewtonOptions& options,
                                             const std::vector<ConvergenceCriterion>& criteria, double stiffness);

/// NOX's view on it: failed if there is a reason.
class GiveUpTest : public IterateTest {
 public:
  GiveUpTest(NewtonHistory& history, const SemiSmoothSystem& system, const NewtonOptions& options, std::vector<ConvergenceCriterion> criteria)
      : IterateTest(history, "no reason to give up"), system_(system), options_(options), criteria_(std::move(criteria)) {}
  const std::optional<StepFailure>& reason() const { return reason_; }

 protected:
  NOX::StatusTest::StatusType check(const Iterates& iterates) override;

 private:
  const SemiSmoothSystem& system_;
  NewtonOptions options_;
  std::vector<ConvergenceCriterion> criteria_;
  std::optional<StepFailure> reason_;
};

}  // namespace mortise::detail
