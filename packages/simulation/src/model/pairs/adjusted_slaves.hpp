#pragma once
// Slave nodes that the pairs of a scene move onto their masters before anything is computed.

#include <vector>

#include "mortise/mesh/mesh.hpp"
#include "mortise/simulation/scene/scene.hpp"
#include "surfaces/adjustment.hpp"

namespace mortise {

/// Components of nodes that the boundary conditions of a scene prescribe.
HeldNodes held_nodes(const Mesh& mesh, const Scene& scene);

/// Moves slave nodes of the pairs that ask for it. Collective.
/// @returns what it did [pairs of the scene]
/// @throws InputError at a pair's place for a curved quadratic master
std::vector<Adjustment> adjust_slaves(Mesh& mesh, const Scene& scene);

}  // namespace mortise
