// Which pairs of facets can come to overlap before the next search.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "interface_implementation.hpp"

namespace mortise {
namespace {

struct Extent {
  double low, high;
};

Extent extent_along(const Eigen::Vector2d& axis, const FacetVectors& nodes) {
  Extent extent{std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
  for (const Eigen::Vector3d& x : nodes) {
    const double s = axis.dot(x.head<2>());
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
    : slave_(slave), normal_(facet_normal(slave[0], slave[1])), tangent_(-normal_.y(), normal_.x()), approach_(motion.approach) {
  for (const NodalNormal& normal : normals) lean_ = std::max(lean_, std::atan2(std::abs(tangent_.dot(normal.normal)), normal_.dot(normal.normal)));
  lean_ += 2.0 * motion.turn;  // the normal's own turn and that of the facet
}

bool OverlapTest<2>::operator()(const FacetPoints<2>& master) const {
  if (lean_ > 1.5) return true;
  const Eigen::Vector2d start = master[0] - slave_[0], end = master[1] - slave_[0];
  const double length = (slave_[1] - slave_[0]).norm(), height = std::max(std::abs(start.dot(normal_)), std::abs(end.dot(normal_)));
  const double slack = 2.0 * approach_ + std::tan(lean_) * (height + 2.0 * approach_);
  return std::max(start.dot(tangent_), end.dot(tangent_)) >= -slack && std::min(start.dot(tangent_), end.dot(tangent_)) <= length + slack;
}

OverlapTest<3>::OverlapTest(const FacetPoints<3>& slave, const std::vector<NodalNormal>&, const Motion& motion)
    : plane_(make_auxiliary_plane(slave)), approach_(motion.approach), tangent_(std::tan(motion.turn)), same_way_(std::sin(2.0 * motion.turn)) {}

// Two convex polygons of the plane are disjoint if an axis e along it, across one of their edges, separates them. After the motion points are nearer
// by `approach` along e at most, and the plane across the new p' may turn by the angle w: e' = e - b p with b = e.p' / p.p', |b| <= tan w, lies along
// it, and still separates points that were more than approach + tan w (height + approach) apart.
bool OverlapTest<3>::operator()(const FacetPoints<3>& master) const {
  if (!plane_) return true;
  if (central_normal(master).normalized().dot(plane_->frame.row(2)) > same_way_) return false;
  FacetVectors nodes;
  for (const Eigen::Vector3d& x : master) nodes.push_back(plane_->to_frame(x));
  const double height = largest_height(plane_->slave) + largest_height(nodes);
  const double slack = approach_ + tangent_ * (height + approach_);
  for (const FacetVectors* polygon : std::array<const FacetVectors*, 2>{&plane_->slave, &nodes})
    for (std::size_t e = 0; e < polygon->size(); ++e) {
      const Eigen::Vector2d edge = ((*polygon)[(e + 1) % polygon->size()] - (*polygon)[e]).head<2>();
      if (!(edge.norm() > 0.0)) continue;
      const Eigen::Vector2d axis = Eigen::Vector2d(-edge.y(), edge.x()).normalized();
      const Extent of_a = extent_along(axis, plane_->slave), of_b = extent_along(axis, nodes);
      if (of_b.low - of_a.high > slack || of_a.low - of_b.high > slack) return false;
    }
  return true;
}

}  // namespace mortise
