#include "corner_normal.hpp"

#include <boost/math/constants/constants.hpp>
#include <cmath>

namespace mortise {
namespace {

/// Angle beyond the wedge up to which the master's normal is followed, and over which that ceases.
constexpr double followed = 10.0 * boost::math::double_constants::degree;

/// From a to b, to the left.
double angle(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)); }

Eigen::Vector2d turned(const Eigen::Vector2d& v, double by) {
  return {std::cos(by) * v.x() - std::sin(by) * v.y(), std::sin(by) * v.x() + std::cos(by) * v.y()};
}

}  // namespace

// The surface turns to the left at a convex corner, and so do the normals. Where it has become concave since it was found to be a corner the wedge is
// the middle of the two.
CornerNormal corner_normal(const Eigen::Vector2d& facing, const Eigen::Vector2d& before, const Eigen::Vector2d& behind) {
  CornerNormal result;
  const Eigen::Vector2d middle = (before + behind).normalized();
  const bool convex = angle(before, behind) > 0.0, to_the_left = angle(middle, facing) > 0.0;
  const Eigen::Vector2d edge = !convex ? middle : (to_the_left ? behind : before);
  const double side = to_the_left ? 1.0 : -1.0, beyond = side * angle(edge, facing);
  if (beyond <= followed) {
    result.normal = facing.normalized();
    return result;
  }
  const double t = std::fmin(beyond / followed - 1.0, 1.0), kept = 1.0 - t * t * (3.0 - 2.0 * t);
  result.normal = turned(edge, side * beyond * kept);
  result.of_master = kept - beyond * 6.0 * t * (1.0 - t) / followed;
  const double of_edge = 1.0 - result.of_master;
  result.of_before = of_edge * (!convex ? 0.5 : (to_the_left ? 0.0 : 1.0));
  result.of_behind = of_edge - result.of_before;
  return result;
}

}  // namespace mortise
