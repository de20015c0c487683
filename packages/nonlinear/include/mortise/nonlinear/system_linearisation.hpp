#pragma once
// J = dF/dx at one iterate, and the semi-smooth Newton step.

#include <memory>
#include <utility>

#include "mortise/nonlinear/held_motions.hpp"
#include "mortise/nonlinear/linear_solver.hpp"
#include "mortise/nonlinear/system_evaluation.hpp"

namespace mortise {

namespace detail {
class SystemModel;
}  // namespace detail

/// Change of the forces of given multipliers with the geometry of contact, d(f_c)/dd at fixed z: included in a direction or not.
enum class GeometricContactStiffness { included, left_out };

/// J at an evaluation. Its stiffness stands in a buffer that all linearisations of a system share: the last one has it at hand, others assemble it
/// again. Collective in all members but the accessor.
class SystemLinearisation {
 public:
  const SystemEvaluation& evaluation() const { return evaluation_; }  ///< where

  /// y = J v by the saddle point blocks.
  void apply(const Vector& v, Vector& y) const;
  /// Newton direction: solves J dx = -F. It does so by condensation or, where the contact keeps multipliers, as a saddle point system. F is the
  /// evaluation's residual. Without contact and followers it may be any vector: a condensing contact forms the rows of C itself. `tolerance`: see
  /// LinearSolver::solve(). Without the geometric stiffness of contact it is not Newton's direction. Where contact's geometry does not change, it
  /// depends on the states of the nodes alone and not on their multipliers. Motions that are `held` are left out of it.
  /// @throws StepFailure (linear_solver) on every rank
  LinearSolveReport newton_direction(const Vector& F, Vector& direction, double tolerance = 0.0,
                                     GeometricContactStiffness geometric_stiffness = GeometricContactStiffness::included,
                                     const HeldMotions* held = nullptr) const;

 private:
  friend class SemiSmoothSystem;
  SystemLinearisation(std::shared_ptr<const detail::SystemModel> model, SystemEvaluation evaluation)
      : model_(std::move(model)), evaluation_(std::move(evaluation)) {}
  std::shared_ptr<const detail::SystemModel> model_;
  SystemEvaluation evaluation_;
};

}  // namespace mortise
