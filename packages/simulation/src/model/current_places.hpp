#pragma once
// Nodes of a mesh in a state of the run.

#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/solid/bodies.hpp"
#include "surfaces/body_surfaces.hpp"

namespace mortise {

/// Of depths, over the size of the model: less is round-off of what touches.
inline constexpr double touching_depth = 1e-6;

/// Where the local nodes are at a displacement [owned dofs]. Collective.
PlaceOfNode current_places(const Bodies& bodies, const Vector& displacement);

/// All bodies at a displacement [owned dofs]. Collective.
PlacedBodies placed_bodies(const Model& model, const Vector& displacement);

/// Marks of owned nodes on all local ones. Collective.
/// @param to_local  from the mesh's owned to its local nodes
std::vector<char> on_local_nodes(const Mesh& mesh, const Import& to_local, const std::vector<char>& owned);

}  // namespace mortise
