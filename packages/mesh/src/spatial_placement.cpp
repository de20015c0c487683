#include "mortise/mesh/spatial_placement.hpp"

#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace mortise {

SpatialPoint SpatialPlacement::operator()(const SpatialPoint& point) const {
  SpatialPoint moved = point;
  if (rotation != 0.0) {
    const double angle = rotation * boost::math::constants::pi<double>() / 180.0, c = std::cos(angle), s = std::sin(angle);
    // From the first to the second of the two directions that follow the axis cyclically.
    const int first = (static_cast<int>(axis) + 1) % 3, second = (static_cast<int>(axis) + 2) % 3;
    moved[first] = c * point[first] - s * point[second];
    moved[second] = s * point[first] + c * point[second];
  }
  for (int i = 0; i < 3; ++i) moved[i] += translation[i];
  return moved;
}

}  // namespace mortise
