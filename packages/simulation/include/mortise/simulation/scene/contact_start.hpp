#pragma once
// Start of the surfaces of a contact pair.

#include <optional>

#include "mortise/core/parameters.hpp"

namespace mortise {

/// Treatment of surfaces that overlap at the start.
enum class InitialOverlap {
  interference,  ///< the overlap is the load that it is
  error          ///< refused
};

/// Where slave nodes begin.
enum class MeshAtStart {
  as_meshed,
  adjusted  ///< moved onto the master, without strain
};

/// Surface that linear facets stand for.
enum class FacetShape { flat, round };

/// Of one pair.
struct ContactStartOptions {
  MeshAtStart mesh = MeshAtStart::as_meshed;
  double tolerance = 0.0;  ///< [length] that nodes are moved at most, if they are adjusted
  FacetShape facets = FacetShape::flat;
  InitialOverlap initial_overlap = InitialOverlap::interference;
  std::optional<double> taken_up_at;  ///< pseudo-time at which nothing is left of an overlap; none: the end of the first step
  void describe(Parameters& parameters);
};

}  // namespace mortise
