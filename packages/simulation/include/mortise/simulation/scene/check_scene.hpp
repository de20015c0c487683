#pragma once
// Errors of a scene before anything is built of it.

#include <vector>

#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Errors of a scene that need no mesh to be seen: names of materials, bodies and quantities, combinations without a meaning.
std::vector<Diagnostic> check_scene(const Scene& scene);

}  // namespace mortise
