#pragma once
// Entries of a scene on heat that have no effect, and heat that flows less than one may think.

#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// In words. Collective.
std::vector<std::string> heat_warnings(const Scene& scene, const Model& model);

}  // namespace mortise
