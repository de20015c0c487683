#pragma once
// Edges that cross and press on one another over less than the mesh resolves.

#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// One line for each crossing of which that is so in a solution, which was examined last. Collective.
std::vector<std::string> crossings_too_coarse(const Model& model, const Scene& scene, const Vector& displacement, const ContactLaws& laws);

}  // namespace mortise
