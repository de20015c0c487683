#pragma once
// Checks of combinations in a scene.

#include <vector>

#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Elements and materials that do not go with the kinematics, and positions of reference points with too many or too few numbers. For a scene that
/// was read without errors: what was refused has its default, which says nothing. No communication.
std::vector<Diagnostic> wrong_combinations(const Scene& scene);

}  // namespace mortise
