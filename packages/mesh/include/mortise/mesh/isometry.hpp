#pragma once
// Where a copy of a body stands.

#include <array>

#include "mortise/mesh/spatial_placement.hpp"

namespace mortise {

/// x -> R x + t with an orthogonal R; a reflection if det R = -1.
struct Isometry {
  std::array<std::array<double, 3>, 3> matrix{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};  ///< R, by rows
  SpatialPoint translation{};                                                                        ///< t [length]

  SpatialPoint operator()(const SpatialPoint& x) const;
  bool reflects() const;
};

/// First `first`, then `second`.
Isometry after(const Isometry& second, const Isometry& first);

/// At the plane through the origin across direction 0 (x), 1 (y) or 2 (z).
Isometry reflection(int direction);

/// By an angle in degrees about an axis (of any length but 0) through a point, counterclockwise seen from its tip.
Isometry rotation(double degrees, const SpatialPoint& axis, const SpatialPoint& point);

}  // namespace mortise
