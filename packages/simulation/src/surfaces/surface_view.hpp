#pragma once
// Findings of the points of one surface about another body.

#include <limits>
#include <optional>
#include <string>

#include "surfaces/body_surfaces.hpp"
#include "surfaces/penetration.hpp"

namespace mortise {

/// Share of a slave surface that is within another body when the whole body is.
inline constexpr double most_of_a_surface = 0.5;

/// One surface of a pair, or of two bodies that are compared.
struct NamedSurface {
  std::string name;
  const SideSet& set;
  std::size_t body;
};

/// Findings of the probes of `from` about the body of `to`.
struct SurfaceView {
  DeepestPoint deepest;
  double probes = 0.0, swallowed = 0.0;  ///< numbers over all ranks
  DeepestPoint swallowed_at;
};

/// Collective, as all of these.
SurfaceView look(const PlacedBodies& bodies, const NamedSurface& from, const NamedSurface& to);

/// From the deepest point on through the other body: how far its back is. No value: it has none there.
std::optional<double> distance_to_back(const PlacedBodies& bodies, const DeepestPoint& deepest, const NamedSurface& to);

/// View of the slave along its normals.
struct Outlook {
  std::optional<double> gap;
  bool backs = false;  ///< no front of the master at all, but for half of the probes or more its back
};

/// @param longest  facet of both surfaces
Outlook look_ahead(const PlacedBodies& bodies, const NamedSurface& slave, const NamedSurface& master, double longest);

}  // namespace mortise
