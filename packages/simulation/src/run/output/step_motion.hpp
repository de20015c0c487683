#pragma once
// Motion of a step, for quantities and fields.

#include <optional>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// Vectors on the owned dofs.
struct StepMotion {
  RCP<const Vector> velocity, acceleration, rate_force, damping_force, displacement_before, velocity_before;
  double dt = 0.0;
  bool is_over_step = false;
  double alpha_f = 0.0;
  RCP<const Vector> external_force_before, damping_force_before;  ///< see MotionOfStep; null: not known

  /// A view, valid while this lives.
  MotionOfStep of_quantities() const;
};

/// Of the step that ends there; none in a scene without inertia, and of an evaluation that ends no step. Collective.
std::optional<StepMotion> step_motion(const Model& model, const SemiSmoothSystem& system, const SystemEvaluation& at);

/// Gives the motion of a first step the forces at its start, which the trapezoidal rule of works needs. Collective.
void add_forces_at_start(const Model& model, const SystemEvaluation& at, StepMotion& motion);

}  // namespace mortise
