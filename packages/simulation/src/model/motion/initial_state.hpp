#pragma once
// The first state of a run.

#include <string>
#include <vector>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Rest, or the initial conditions of a scene with inertia. Prescribed dofs have the velocities and accelerations of their functions. Collective.
/// @throws InputError on all ranks for bodies that do not exist, rigid bodies that change their shape, functions without a value
AcceptedState initial_state(const Scene& scene, const Model& model, const SemiSmoothSystem& system);

/// Warnings where supports of deformable bodies do not begin as the bodies do: at another place, or with another velocity. None without inertia.
/// Collective.
std::vector<std::string> jumps_at_start(const Scene& scene, const Model& model);

}  // namespace mortise
