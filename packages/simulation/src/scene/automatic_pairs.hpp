#pragma once
// From surfaces that face one another to contact pairs of the scene.

#include "mortise/mesh/mesh.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// Adds pairs and the sets that they need to the scene if it asks for them. Then the request is cleared, so that effective.xml gives the same again.
/// The sides of a pair are chosen as roles.hpp says, then the more curved one is the slave. Where a patch would be slave and master at once it is
/// split among those that face it. Neither names nor the order of bodies count. Collective.
/// @param mesh  of the scene, with its sets
/// @throws InputError for bodies that are none; nothing that faces anything
void add_automatic_pairs(const Mesh& mesh, Scene& scene);

}  // namespace mortise
