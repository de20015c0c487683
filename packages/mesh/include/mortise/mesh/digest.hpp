#pragma once
// Comparison of two meshes by a digest.

#include <string>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Sixteen hexadecimal digits. They depend on the places of the nodes and on the nodes of the elements, by their ids. They do not depend on how these
/// are shared out over ranks. Collective.
std::string mesh_digest(const Mesh& mesh);

}  // namespace mortise
