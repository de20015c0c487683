#include "mortise/mesh/spatial_placement.hpp"

#include <Eigen/Geometry>
#include <boost/math/constants/constants.hpp>

namespace mortise {

SpatialPoint SpatialPlacement::operator()(const SpatialPoint& point) const {
  using Eigen::Vector3d;
  SpatialPoint moved = point;
  if (rotation != 0.0) {
    const double angle = rotation * boost::math::constants::pi<double>() / 180.0;
    Vector3d::Map(moved.data()) = Eigen::AngleAxisd(angle, Vector3d::Map(axis.data()).normalized()) * Vector3d::Map(point.data());
  }
  for (int i = 0; i < 3; ++i) moved[i] += translation[i];
  return moved;
}

}  // namespace mortise
