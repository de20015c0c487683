#pragma once
// What is wrong with a scene before anything is built of it.

#include <vector>

#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// What a scene says wrongly that needs no mesh to be seen: names of materials, bodies and quantities, combinations without a meaning.
std::vector<Diagnostic> check_scene(const Scene& scene);

}  // namespace mortise
