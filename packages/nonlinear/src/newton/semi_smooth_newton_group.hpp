#pragma once
// The semi-smooth system as NOX sees it.

#include <NOX_Abstract_Group.H>
#include <NOX_Thyra_Vector.H>

#include <limits>
#include <memory>
#include <optional>

#include "mortise/core/error.hpp"
#include "mortise/nonlinear/newton_solver.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"

namespace mortise::detail {

/// The Tpetra vector inside a NOX vector.
RCP<Vector> tpetra_vector(NOX::Abstract::Vector& vector);
RCP<const Vector> tpetra_vector(const NOX::Abstract::Vector& vector);
/// A NOX vector that shares the memory of a Tpetra vector.
NOX::Thyra::Vector nox_vector(const RCP<Vector>& vector);

/// Treatment of a Newton direction beyond solving for it.
struct StepControl {
  std::optional<double> largest_increment;  ///< max |du| of a direction; longer ones are scaled down as a whole
  bool trial = false;                       ///< a line search tries iterates: one that has no residual has an infinite norm instead of a failure
  double momentum_tolerance = 0.0;          ///< of ResidualNorms::momentum: a linear solve does not go far below it
  double increment_tolerance = 0.0;         ///< [size of the first field] nothing has converged after a larger correction
};

/// An iterate x = (d, z) with its evaluation and, once computed, the Newton direction. All clones share one system and the last linearisation; each
/// iterate has a number, and the linearisation remembers the number of its iterate. StepFailure passes through NOX. A copy of a group has F(x), but
/// not the evaluation: contact at an iterate takes memory, and NOX keeps old iterates.
class SemiSmoothNewtonGroup : public NOX::Abstract::Group {
 public:
  SemiSmoothNewtonGroup(const SemiSmoothSystem& system, SystemEvaluation start, const StepControl& control);
  SemiSmoothNewtonGroup(const SemiSmoothNewtonGroup& other, NOX::CopyType type);
  NOX::Abstract::Group& operator=(const NOX::Abstract::Group& other) override;
  RCP<NOX::Abstract::Group> clone(NOX::CopyType type = NOX::DeepCopy) const override;

  void setX(const NOX::Abstract::Vector& y) override;
  void computeX(const NOX::Abstract::Group& group, const NOX::Abstract::Vector& direction, double step) override;
  ReturnType computeF() override;
  ReturnType computeJacobian() override;
  /// By condensation, for -F(x) alone: the rows of C are formed by the contact, so there is no applyJacobianInverse for other vectors.
  ReturnType computeNewton(Teuchos::ParameterList& parameters) override;

  bool isF() const override { return has_F_; }
  bool isJacobian() const override { return shared_->jacobian_of == number_; }
  bool isGradient() const override { return false; }
  bool isNewton() const override { return has_newton_; }
  const NOX::Abstract::Vector& getX() const override { return *x_; }
  const NOX::Abstract::Vector& getF() const override { return *F_; }
  /// ResidualNorms::merit, what a line search looks at: |F| itself adds forces and pressures.
  double getNormF() const override { return norms_.merit; }
  const NOX::Abstract::Vector& getGradient() const override;
  const NOX::Abstract::Vector& getNewton() const override { return *newton_; }
  RCP<const NOX::Abstract::Vector> getXPtr() const override { return x_; }
  RCP<const NOX::Abstract::Vector> getFPtr() const override { return F_; }
  RCP<const NOX::Abstract::Vector> getGradientPtr() const override { return Teuchos::null; }
  RCP<const NOX::Abstract::Vector> getNewtonPtr() const override { return newton_; }

  const ResidualNorms& norms() const { return norms_; }
  /// Why an iterate that was tried has no residual.
  const std::optional<StepFailure>& failure() const { return failure_; }
  /// max |du| of the step that led here; negative if none did.
  double increment() const { return increment_; }
  /// Share of the Newton direction that led here.
  double step_length() const { return step_length_; }
  /// True if the Newton direction is that of SystemParts::better_start: then nothing is known of the residual on the way.
  bool starts_elsewhere() const { return starts_elsewhere_; }
  /// Of the linear solve that led here.
  const LinearSolveReport& linear_solve() const { return linear_solve_; }
  /// The iterate, evaluated; again if it is a copy's.
  const SystemEvaluation& evaluation();
  /// The iterate of any clone that was linearised last, and what it was evaluated with; nothing if none was.
  const std::optional<LinearisedIterate>& linearised() const { return shared_->linearised; }

 private:
  struct Shared {
    StepControl control;
    StepContext context;  ///< of the next evaluation
    std::optional<LinearisedIterate> linearised;
    std::optional<SystemLinearisation> jacobian;
    unsigned long next = 1, jacobian_of = 0;
  };
  void become_new_iterate();
  const SystemLinearisation& linearise(const SystemEvaluation& at);
  double linear_tolerance(double forcing) const;

  const SemiSmoothSystem* system_;
  std::shared_ptr<Shared> shared_;
  unsigned long number_;
  RCP<NOX::Thyra::Vector> x_, F_, newton_;
  bool has_F_ = false, has_newton_ = false, starts_elsewhere_ = false;
  double increment_ = -1.0, step_length_ = 1.0;
  double shortened_ = 1.0;  ///< share of the Newton direction that `newton_` is
  ResidualNorms norms_;
  LinearSolveReport linear_solve_, newton_solve_;
  std::optional<StepFailure> failure_;
  std::optional<SystemEvaluation> evaluation_;  ///< of x; none: not yet, or not here
};

}  // namespace mortise::detail
