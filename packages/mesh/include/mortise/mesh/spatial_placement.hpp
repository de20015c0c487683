#pragma once
// Where a body of space stands.

#include <array>

namespace mortise {

/// A position in space.
using SpatialPoint = std::array<double, 3>;

enum class Axis { x, y, z };

/// Rotation about an axis through the origin, then translation.
struct SpatialPlacement {
  Axis axis = Axis::z;
  double rotation = 0.0;  ///< degrees, counterclockwise seen from the axis' tip
  SpatialPoint translation{};
  SpatialPoint operator()(const SpatialPoint& point) const;
};

}  // namespace mortise
