#pragma once
// Named sets of a mesh: derived ones, look-up with errors, and the facets of surfaces.

#include <string>
#include <vector>

#include "mortise/core/parameters.hpp"
#include "mortise/core/scalar_function.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/shape/surface_facet.hpp"

namespace mortise {

enum class SetKind { nodes, sides };

/// A set derived from another one.
struct SetOptions {
  Located<std::string> of;    ///< name of a side set ("body/side") or, for nodes, also of a node set ("body")
  ScalarFunction where{1.0};  ///< of x, y and z (reference); kept where > 0, at a node or at the middle of a side
  SetKind kind = SetKind::nodes;
  void describe(Parameters& parameters);
};

/// Adds the set `name` to the mesh. Collective. A set of sides is a set of its nodes too.
/// @throws InputError on all ranks: the name is taken, `of` does not exist, nothing is kept.
void add_set(Mesh& mesh, const Named<SetOptions>& set);

/// The set, or InputError at the name's place with the nearest name and the list of sets.
const SideSet& require_side_set(const Mesh& mesh, const Located<std::string>& name);
const std::vector<LocalOrdinal>& require_node_set(const Mesh& mesh, const Located<std::string>& name);

/// Every facet of the set with a node owned by this rank (a facet may stand on two ranks).
SurfaceFacets facets_at_owned_nodes(const Mesh& mesh, const SideSet& set);

/// The facets of the set that belong to owned elements (each on exactly one rank).
SurfaceFacets facets_of_owned_elements(const Mesh& mesh, const SideSet& set);

}  // namespace mortise
