#pragma once
// Surfaces and bodies before anything has moved: their overlaps with depth and place, and what cannot be right.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mortise/mesh/mesh.hpp"
#include "mortise/simulation/scene/scene.hpp"

namespace mortise {

/// A deepest overlap of two bodies.
struct OverlapPlace {
  double depth = 0.0;  ///< along the normal of the surface whose node it is: from there back to the other body's front; 0: none
  GlobalOrdinal node = 0;
  std::string surface;  ///< the set that the node is of
  std::array<double, 3> place{};
};

/// "node 12 of "top/bottom" at (0, -0.24)".
std::string to_string(int dimension, const OverlapPlace& overlap);

/// State of a contact pair at the start.
struct PairAtStart {
  OverlapPlace overlap;
  std::optional<double> gap;    ///< without overlap: least distance along the slave's normals to the master; none: the slave sees no front of it
  double longest = 0.0;         ///< facet of either surface
  std::optional<double> reach;  ///< search reach that covers the overlap, where that is more than the longest facet
  std::pair<GlobalOrdinal, double> adjusted{0, 0.0};  ///< number of slave nodes that were moved onto the master, and the largest distance [length]
  double overlap_as_meshed = 0.0;                     ///< depth before slave nodes were moved, if they were [length]
  std::array<double, 2> arcs{0.0, 0.0};    ///< the most that linear facets leave of the slave's arcs, and of the master's, if one is hollow where the
                                           ///< other is convex; else 0 [length]
  std::array<double, 2> facets{0.0, 0.0};  ///< longest one of the slave, and of the master
  std::optional<std::array<double, 2>> facet_gaps;  ///< least and largest of what is added to gaps for round facets
  bool is_swallowed = false;                        ///< most of the slave begins within the master's body; another pair of these bodies pushes it out
};

/// Two bodies that overlap and may not touch.
struct StrayOverlap {
  std::string first, second;
  OverlapPlace overlap;  ///< depth 0: one lies wholly within the other
};

struct SurfacesAtStart {
  std::vector<PairAtStart> pairs;  ///< in the order of the scene
  std::vector<StrayOverlap> strays;
};

/// Collective. Lines along the normals of each surface are compared with the whole surface of the other body: facets of any size and any depth count.
/// @param length  size of the model; overlaps below 1e-6 of it are round-off of what was meant to touch
/// @throws InputError at the pair's place:
///   - an overlap where the scene allows none;
///   - an overlap that a given search reach does not cover, or that reaches beyond the middle of the body that it goes into;
///   - a slave wholly within or behind its master;
///   - a master that turns its back.
SurfacesAtStart examine_surfaces(const Mesh& mesh, const Scene& scene, double length);

/// Depth of the overlap of a pair's surfaces, as examine_surfaces() sees it. Collective.
double deepest_overlap(const Mesh& mesh, const Named<ContactPairOptions>& pair, double length);

}  // namespace mortise
