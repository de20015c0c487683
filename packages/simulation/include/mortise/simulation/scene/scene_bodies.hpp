#pragma once
// Meshes of a scene, as build_mesh() and plan_mesh() take them, and properties of the blocks of a mesh.

#include <string>
#include <vector>

#include "mortise/mesh/build_mesh.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// The element that a body has in cells of a shape: the one that the scene names if it has that shape, else the standard one.
ElementType element_of(const BodyOptions& body, CellShape shape);

/// The element of a body whose mesh is generated.
ElementType element_of(const BodyOptions& body);

/// The name of the material that a part of a body has; empty: none.
std::string material_name(const BodyOptions& body, const std::string& part);

/// Reads meshes of files. Collective.
/// @throws InputError for what make_file_bodies() refuses
std::vector<BodyDescription> body_descriptions(const Communicator& comm, const Scene& scene);

/// Properties of each block of the mesh.
/// @throws InputError: elements that the body's cells have not, cells without a material
std::vector<BodyProperties> block_properties(const Scene& scene, const Mesh& mesh);

/// Young's modulus of a block's material; infinite for a rigid body.
double youngs_modulus(const Scene& scene, const Mesh& mesh, const Block& block);

/// True if a block has a temperature in a scene with heat: its material has a conductivity, or it is rigid and has one of its own.
bool has_temperature(const Scene& scene, const Mesh& mesh, const Block& block);

/// The sides of all contact pairs, "body/side"; a set of the scene counts as the side that it is a part of.
std::vector<std::string> contact_sides(const Scene& scene);

}  // namespace mortise
