#pragma once
// Sizes of meshes, before any of them is built.

#include <vector>

#include "mortise/mesh/build_mesh.hpp"

namespace mortise {

/// Of one body.
struct MeshCounts {
  GlobalOrdinal elements = 0, nodes = 0;
  int least_nodes_of_element = 0;
  bool is_solid = true;  ///< no surface of a rigid body
};

/// Of each body, from its description alone, in no time and memory. Throws InputError for what build_mesh() refuses of descriptions.
std::vector<MeshCounts> mesh_counts(const std::vector<BodyDescription>& bodies);

}  // namespace mortise
