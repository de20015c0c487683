// Pairs of facets that can come to overlap before the next search.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "interface/interface_implementation.hpp"

namespace mortise {
namespace {

struct Extent {
  double low, high;
};

// Of positions relative to `origin`, by their first two components.
template <class Points>
Extent extent_along(const Eigen::Vector2d& axis, const Points& points, const Eigen::Vector2d& origin) {
  Extent extent{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  for (const auto& x : points) {
    const double s = axis.dot(x.template head<2>() - origin);
    extent.low = std::min(extent.low, s);
    extent.high = std::max(extent.high, s);
  }
  return extent;
}

double largest_height(const FacetVectors& nodes) {
  double largest = 0.0;
  for (const Eigen::Vector3d& x : nodes) largest = std::max(largest, std::abs(x.z()));
  return largest;
}

}  // namespace

OverlapTest<2>::OverlapTest(const FacetPoints<2>& slave, const std::vector<NodalNormal>& normals, const Motion& motion)
    : slave_(control_points<2>(slave)), approach_(motion.approach) {
  tangent_ = (slave[1] - slave[0]).normalized();
  normal_ = {tangent_.y(), -tangent_.x()};
  for (const NodalNormal& normal : normals) lean_ = std::max(lean_, std::atan2(std::abs(tangent_.dot(normal.normal)), normal_.dot(normal.normal)));
  lean_ += 2.0 * motion.turn;  // the normal's own turn and that of the facet
}

bool OverlapTest<2>::operator()(const FacetPoints<2>& master) const {
  if (lean_ > 1.5) return true;
  const FacetPoints<2> points = control_points<2>(master);
  const auto along = [&](const FacetPoints<2>& x) { return extent_along(tangent_, x, slave_[0]); };
  const auto across = [&](const FacetPoints<2>& x) { return extent_along(normal_, x, slave_[0]); };
  const Extent of_slave = along(slave_), of_master = along(points), depth = across(slave_), heights = across(points);
  const double height = std::max(std::abs(heights.low - depth.high), std::abs(heights.high - depth.low));
  const double slack = 2.0 * approach_ + std::tan(lean_) * (height + 2.0 * approach_);
  return of_master.high >= of_slave.low - slack && of_master.low <= of_slave.high + slack;
}

OverlapTest<3>::OverlapTest(const FacetPoints<3>& slave, const std::vector<NodalNormal>&, const Motion& motion)
    : plane_(make_auxiliary_plane(slave)), approach_(motion.approach), tangent_(std::tan(motion.turn)), same_way_(std::sin(2.0 * motion.turn)) {
  for (const FacetPart& part : linear_parts(3, slave.size()))
    if (plane_) parts_.push_back(part_of(plane_->slave, part));
}

bool OverlapTest<3>::operator()(const FacetPoints<3>& master) const {
  if (!plane_) return true;
  FacetVectors nodes;
  for (const Eigen::Vector3d& x : master) nodes.push_back(plane_->to_frame(x));
  for (const FacetPart& part : linear_parts(3, master.size())) {
    const FacetVectors of_master = part_of(nodes, part);
    if (central_normal(of_master).normalized().z() > same_way_) continue;
    for (const FacetVectors& of_slave : parts_)
      if (!stay_apart(of_slave, of_master)) return true;
  }
  return false;
}

// Two convex polygons of the plane are disjoint if an axis e along the plane, across one of their edges, separates them. After the motion points are
// nearer by `approach` along e at most, and the plane across the new p' may turn by the angle w. Then e' = e - b p with b = e.p' / p.p', |b| <= tan
// w, lies along that plane. It still separates points that were more than approach + tan w (height + approach) apart.
bool OverlapTest<3>::stay_apart(const FacetVectors& slave, const FacetVectors& master) const {
  const double height = largest_height(slave) + largest_height(master);
  const double slack = approach_ + tangent_ * (height + approach_);
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  for (const FacetVectors* polygon : {&slave, &master})
    for (std::size_t e = 0; e < polygon->size(); ++e) {
      const Eigen::Vector2d edge = ((*polygon)[(e + 1) % polygon->size()] - (*polygon)[e]).head<2>();
      if (!(edge.norm() > 0.0)) continue;
      const Eigen::Vector2d axis = Eigen::Vector2d(-edge.y(), edge.x()).normalized();
      const Extent of_a = extent_along(axis, slave, origin), of_b = extent_along(axis, master, origin);
      if (of_b.low - of_a.high > slack || of_a.low - of_b.high > slack) return true;
    }
  return false;
}

}  // namespace mortise
