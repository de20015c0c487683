#pragma once
// Parts of a run with inertia that look at its steps.

#include <functional>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// The local error of steps, energy that impacts take, and speeds beyond what the search of contact sees, as the scene calls for them.
StepGuards transient_guards(const Model& model, const Scene& scene, std::function<void(const std::string&)> warn);

}  // namespace mortise
