#pragma once
// What a scene says of its meshes, as build_mesh() and plan_mesh() take it.

#include <string>
#include <vector>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

std::vector<BodyDescription> body_descriptions(const Scene& scene);

/// The sides of all contact pairs, "body/side"; a set of the scene counts as the side that it is a part of.
std::vector<std::string> contact_sides(const Scene& scene);

}  // namespace mortise
