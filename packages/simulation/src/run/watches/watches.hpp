#pragma once
// Guards that assume nothing of the analysis: bodies, surfaces and meshes alone decide what they say.

#include <functional>
#include <string>

#include "mortise/simulation/model/model.hpp"
#include "run/stepping/step_guard.hpp"

namespace mortise {

/// The guards that a model has a use for.
/// @param warn  gets their warnings, on every rank
StepGuards watches(const Model& model, const Scene& scene, const std::function<void(const std::string&)>& warn);

}  // namespace mortise
