#pragma once
// Heat of a step, as quantities see it.

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/quantity.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Without values of a step: names of what flows.
HeatOfStep heat_of_step(const Scene& scene, const Model& model);

/// After the step was committed.
/// @param reaction  has to outlive the result
HeatOfStep heat_of_step(const Scene& scene, const Model& model, const SemiSmoothSystem& system, const SystemEvaluation& at, const Vector& reaction,
                        double time_step);

}  // namespace mortise
