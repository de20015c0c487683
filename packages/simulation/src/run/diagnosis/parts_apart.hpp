#pragma once
// Bodies that begin apart, under loads that nothing bears until they touch.

#include <string>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Advice if the first step failed and no pair of the bodies that contact alone holds touched at its start. It names how far the load carries each of
/// them until they touch, as translations of their meshes. Empty: that is not so. Collective.
std::string advise_parts_apart(const FailedTry& failed, const Model& model, const Scene& scene, const SemiSmoothSystem& system);

}  // namespace mortise
