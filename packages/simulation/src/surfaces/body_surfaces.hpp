#pragma once
// The surfaces of all bodies as oriented facets at given positions.

#include <functional>
#include <memory>
#include <vector>

#include "mortise/mesh/mesh.hpp"
#include "mortise/mortar/line_crossings.hpp"

namespace mortise {

/// Position of a local node; in 2D z = 0.
using PlaceOfNode = std::function<Eigen::Vector3d(LocalOrdinal node)>;

PlaceOfNode reference_places(const Mesh& mesh);

FacetPlaces places_of(const Mesh& mesh, const Side& side, const PlaceOfNode& at);

/// The facets of a body on this rank, each on one rank: those of `set` with the tag `in_set`, the others of its surface with `elsewhere`.
std::vector<TaggedFacet> tagged_surface(const Mesh& mesh, std::size_t body, const SideSet& set, int in_set, int elsewhere, const PlaceOfNode& at);

/// The side set that is the whole surface of a body.
const SideSet& whole_surface(const Mesh& mesh, std::size_t body);

/// True if a body is made of a surface alone, with a solid side and no inside.
bool is_rigid(const Mesh& mesh, std::size_t body);

/// The box of each body's surface, over all ranks. Collective.
std::vector<Box3> body_boxes(const Mesh& mesh, const PlaceOfNode& at);

/// All bodies in one configuration, as those share it who ask about their surfaces.
struct PlacedBodies {
  const Mesh& mesh;
  PlaceOfNode at;
  std::vector<Box3> boxes;  ///< of the bodies' surfaces, over all ranks
  double length;            ///< size of the model
  double touching;          ///< shorter depths are none
};

/// Sides of a set that belong to one body.
struct SidesOfBody {
  std::size_t body = 0;
  std::shared_ptr<const SideSet> set;  ///< may be empty on this rank
};

/// A set by bodies, of which it has one or more; the same ones on every rank. Of one body alone it is the set itself, which has to stay. Collective.
std::vector<SidesOfBody> sides_by_body(const Mesh& mesh, const SideSet& set);

/// A point of a surface with the node that it is next to.
struct SurfaceProbe {
  SurfacePoint point;
  LocalOrdinal node = 0;
};

/// The points of the set's facets on this rank.
std::vector<SurfaceProbe> probes_of(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at);

/// Lengths between the corners of a facet that follow one another, ascending.
std::vector<double> side_lengths(const Mesh& mesh, const Side& side, const PlaceOfNode& at);

/// Length of the longest facet of the set, over all ranks, between corners. Collective.
double longest_facet(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at);

/// The most by which quadratic facets leave their linear parts, over all ranks; 0 of linear facets. A parabola of the sagitta s leaves the chords of
/// its halves by s/4 at most; a facet of a 3D body does so in two directions. Collective.
double deviation_from_parts(const Mesh& mesh, const SideSet& set, const PlaceOfNode& at);

}  // namespace mortise
