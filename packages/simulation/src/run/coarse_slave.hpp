#pragma once
// Forces on so few slave nodes that the master's curvature within their facets decides on approach and pressure.

#include <string>
#include <vector>

#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// One line for each pair of which that is so in a solution, at which contact was evaluated last. Collective.
std::vector<std::string> slaves_too_coarse(const Model& model, const Scene& scene, const Vector& displacement, const ContactLaws& laws);

}  // namespace mortise
