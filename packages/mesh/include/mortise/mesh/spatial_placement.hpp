#pragma once
// Where a 3D body stands.

#include <array>

namespace mortise {

/// A position in 3D.
using SpatialPoint = std::array<double, 3>;

/// Rotation about an axis through the origin, then translation.
struct SpatialPlacement {
  SpatialPoint axis{0.0, 0.0, 1.0};  ///< of any length but 0
  double rotation = 0.0;             ///< degrees, counterclockwise seen from the axis' tip
  SpatialPoint translation{};
  SpatialPoint operator()(const SpatialPoint& point) const;
};

}  // namespace mortise
