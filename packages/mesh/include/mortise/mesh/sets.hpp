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

/// A set derived from others: those of a union that are in others, not in others, and where conditions hold. A side is where its middle is.
struct SetOptions {
  Located<std::vector<std::string>> of;       ///< union: names of side sets ("body/side") or, for nodes, also of node sets ("body")
  Located<std::vector<std::string>> also_in;  ///< intersection: kept is what is in each of these too
  Located<std::vector<std::string>> not_in;   ///< difference: left out is what is in any of these
  ScalarFunction where{1.0};                  ///< of x, y and z (reference); kept where > 0
  std::vector<double> box;                    ///< lowest and highest corner: x, y(, z), x, y(, z); empty: everywhere
  std::vector<double> sphere;                 ///< middle and radius: x, y(, z), r; empty: everywhere
  std::vector<double> normal;                 ///< outward direction of sides; empty: any
  double angle = 10.0;                        ///< [degrees] that the normal of a side may differ from `normal`
  std::vector<double> patch;                  ///< the smooth part of the surface around the side nearest to this point; empty: all parts
  double patch_angle = 30.0;                  ///< [degrees] between sides at the edges that bound it
  std::vector<double> nearest;                ///< of all that is left, the one nearest to this point; empty: all
  SetKind kind = SetKind::nodes;
  void describe(Parameters& parameters);
};

/// Adds the set `name` to the mesh. Collective. A set of sides is a set of its nodes too.
/// @throws InputError on all ranks: the name is taken, a named set does not exist, a condition has not as many numbers as the mesh has dimensions,
/// nothing is kept.
void add_set(Mesh& mesh, const Named<SetOptions>& set);

/// Adds sets, each after those that it is made of, in whatever order they stand. Collective.
/// @throws InputError on all ranks: as add_set(), and for sets that are made of themselves
void add_sets(Mesh& mesh, const std::vector<Named<SetOptions>>& sets);

/// The set, or InputError at the name's place with the nearest name and the list of sets.
const SideSet& require_side_set(const Mesh& mesh, const Located<std::string>& name);
const std::vector<LocalOrdinal>& require_node_set(const Mesh& mesh, const Located<std::string>& name);

/// Every facet of the set with a node owned by this rank (a facet may stand on two ranks).
SurfaceFacets facets_at_owned_nodes(const Mesh& mesh, const SideSet& set);

/// The facets of the set that belong to owned elements (each on exactly one rank).
SurfaceFacets facets_of_owned_elements(const Mesh& mesh, const SideSet& set);

}  // namespace mortise
