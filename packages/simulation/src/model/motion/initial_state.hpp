#pragma once
// The first state of a run.

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Rest, or the initial conditions of a scene with inertia. Prescribed dofs have the velocities and accelerations of their functions. Collective.
/// @throws InputError on all ranks for bodies that do not exist, rigid bodies that change their shape, functions without a value
AcceptedState initial_state(const Scene& scene, const Model& model, const SemiSmoothSystem& system);

}  // namespace mortise
