#pragma once
// The readers of the formats of meshes: each returns what the file says, or throws InputError or FileError.

#include <string>

#include "mortise/mesh/mesh_file.hpp"

namespace mortise {

MeshFile read_exodus(const std::string& path);
MeshFile read_gmsh(const std::string& path);
MeshFile read_abaqus(const std::string& path);

}  // namespace mortise
