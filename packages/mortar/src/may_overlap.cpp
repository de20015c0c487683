// Which pairs of facets can come to overlap before the next search.

#include <cmath>

#include "interface_implementation.hpp"
#include "mortise/mortar/auxiliary_plane.hpp"

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

bool may_overlap(const FacetPoints<2>& a, const FacetPoints<2>& b, const std::vector<NodalNormal>& normals, const Motion& motion) {
  const double length = (a[1] - a[0]).norm();
  const Eigen::Vector2d n = facet_normal(a[0], a[1]), t(-n.y(), n.x());
  double lean = 0.0;  // of the nodal normals to the sides, as an angle
  for (const NodalNormal& normal : normals) lean = std::max(lean, std::atan2(std::abs(t.dot(normal.normal)), n.dot(normal.normal)));
  lean += 2.0 * motion.turn;  // the normal's own turn and that of the facet
  if (lean > 1.5) return true;
  const Eigen::Vector2d start = b[0] - a[0], end = b[1] - a[0];
  const double height = std::max(std::abs(start.dot(n)), std::abs(end.dot(n)));
  const double slack = 2.0 * motion.approach + std::tan(lean) * (height + 2.0 * motion.approach);
  return std::max(start.dot(t), end.dot(t)) >= -slack && std::min(start.dot(t), end.dot(t)) <= length + slack;
}

// Two convex polygons of the plane are disjoint if one of their edges' normals separates them. When the plane turns by the angle w, places on it that
// are d apart and h over one another come to be d cos w - h sin w apart: they stay separated for d > h tan w.
bool may_overlap(const FacetPoints<3>& a, const FacetPoints<3>& b, const std::vector<NodalNormal>&, const Motion& motion) {
  const auto plane = make_auxiliary_plane(a);
  if (!plane) return true;
  if (central_normal(b).normalized().dot(plane->frame.row(2)) > std::sin(2.0 * motion.turn)) return false;  // faces the same way
  FacetVectors nodes;
  for (const Eigen::Vector3d& x : b) nodes.push_back(plane->to_frame(x));
  const double height = largest_height(plane->slave) + largest_height(nodes);
  const double slack = 2.0 * motion.approach / std::cos(motion.turn) + std::tan(motion.turn) * (height + 2.0 * motion.approach);
  for (const FacetVectors* polygon : std::array<const FacetVectors*, 2>{&plane->slave, &nodes})
    for (std::size_t e = 0; e < polygon->size(); ++e) {
      const Eigen::Vector2d edge = ((*polygon)[(e + 1) % polygon->size()] - (*polygon)[e]).head<2>();
      if (!(edge.norm() > 0.0)) continue;
      const Eigen::Vector2d axis = Eigen::Vector2d(-edge.y(), edge.x()).normalized();
      const Extent of_a = extent_along(axis, plane->slave), of_b = extent_along(axis, nodes);
      if (of_b.low - of_a.high > slack || of_a.low - of_b.high > slack) return false;
    }
  return true;
}

}  // namespace mortise
