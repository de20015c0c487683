#pragma once
// From descriptions of bodies to a distributed mesh.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/mesh/isometry.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/mesh/mesh_options.hpp"
#include "mortise/mesh/reference_point.hpp"

namespace mortise {

/// Shape of the cells of a rigid body's surface, in a 2D or 3D mesh.
constexpr CellShape rigid_shape(int dimension) { return dimension == 2 ? CellShape::line2 : CellShape::quadrilateral4; }

/// A body to be meshed.
struct BodyDescription {
  std::string name;
  Place place;
  std::shared_ptr<const MeshOptions> mesh;
  CellShape shape = CellShape::quadrilateral4;  ///< rigid_shape(): a rigid body, of which the surface alone is meshed
  std::shared_ptr<ListedBody> listed{};         ///< of a mesh file: then `mesh` and `shape` say nothing
  std::optional<Isometry> copy{};               ///< moves or reflects the mesh; none: it stays

  /// Of its mesh: 2 or 3.
  int dimension() const { return listed ? listed->dimension : mesh->dimension(); }
};

/// Builds the mesh of all bodies. Collective. Node and element ids are contiguous per body, in the order of `bodies`, and do not depend on the number
/// of ranks. On more than one rank METIS distributes the elements. It balances both their number and that of the elements on `contact_sides`
/// ("body/side"). Names that are no sides of the bodies are passed over (see require_side_set). Besides its named sides each body gets a side set
/// "body/surface" (all of them) and a node set "body" (all its nodes). Bodies of mesh files have a block for each shape and each part with a material
/// of its own, other bodies have one block. Reference points get the ids beyond those of all bodies, and a node set each;
/// followers come with add_followers(). All bodies are 2D, or all are 3D.
/// @throws InputError on all ranks: no body, repeated names, bodies of different dimension, elements that do not fit the mesh, shapes without
/// meaning, an inverted element (with its det J).
RCP<Mesh> build_mesh(const RCP<const Communicator>& comm, const std::vector<BodyDescription>& bodies, const std::vector<std::string>& contact_sides,
                     const std::vector<ReferencePointDescription>& reference_points = {});

/// Size of a mesh over all ranks.
struct MeshSize {
  GlobalOrdinal nodes = 0, elements = 0;
  std::vector<GlobalOrdinal> elements_of_block;
  double length = 0.0;         ///< diagonal of the box around all reference positions: the characteristic length
  double shortest_side = 0.0;  ///< shortest edge of all elements
};
/// Collective.
MeshSize mesh_size(const Mesh& mesh);

}  // namespace mortise
