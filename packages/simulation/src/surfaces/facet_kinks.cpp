#include "surfaces/facet_kinks.hpp"

#include <Eigen/Geometry>

#include "mortise/mortar/quadratic_facet.hpp"

namespace mortise {

Eigen::Vector3d facet_normal(int dimension, const FacetPlaces& x) {
  const std::size_t corners = facet_corners(dimension, x.size());
  Eigen::Vector3d normal;
  if (dimension == 2)
    normal = {x[1][1] - x[0][1], x[0][0] - x[1][0], 0.0};
  else
    normal = corners == 3 ? (x[1] - x[0]).cross(x[2] - x[0]) : (x[2] - x[0]).cross(x[3] - x[1]);
  return normal.normalized();
}

Eigen::Vector3d facet_centre(const FacetPlaces& x) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : x) centre += point / static_cast<double>(x.size());
  return centre;
}

}  // namespace mortise
