#pragma once
// Whether two meshes are the same.

#include <string>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Sixteen hexadecimal digits that depend on the nodes with their places and on the elements with their nodes, by their ids, and not on how they are
/// shared out over ranks. Collective.
std::string mesh_digest(const Mesh& mesh);

}  // namespace mortise
