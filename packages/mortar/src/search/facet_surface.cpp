#include "mortise/mortar/facet_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "mortise/mortar/quadratic_facet.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/line3.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {
namespace {

/// Calls act(Shape()) with the shape of a facet.
template <class Act>
auto visit_facet(int dimension, std::size_t nodes, const Act& act) {
  if (dimension == 2) return nodes == 2 ? act(Line2()) : act(Line3());
  switch (nodes) {
    case 3:
      return act(Triangle3());
    case 4:
      return act(Quadrilateral4());
    case 6:
      return act(Triangle6());
    case 8:
      return act(Quadrilateral8());
    default:
      throw std::invalid_argument("no facet in 3D has " + std::to_string(nodes) + " nodes");
  }
}

}  // namespace

FacetPoint facet_point(int dimension, const FacetPlaces& facet, const Eigen::Vector2d& xi) {
  return visit_facet(dimension, facet.size(), [&](auto shape) {
    using Shape = decltype(shape);
    std::array<double, Shape::dimension> at{};
    for (int i = 0; i < Shape::dimension; ++i) at[static_cast<std::size_t>(i)] = xi[i];
    const auto N = Shape::values(at);
    const auto dN = Shape::gradients(at);
    const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
    FacetPoint point{zero, {zero, zero}, zero};
    for (std::size_t a = 0; a < facet.size(); ++a) {
      point.x += N[a] * facet[a];
      for (std::size_t i = 0; i < Shape::dimension; ++i) point.tangent[i] += dN[a][i] * facet[a];
    }
    if constexpr (Shape::dimension == 1)
      point.normal = {point.tangent[0][1], -point.tangent[0][0], 0.0};
    else
      point.normal = point.tangent[0].cross(point.tangent[1]);
    return point;
  });
}

Eigen::Vector2d facet_node(int dimension, std::size_t nodes, std::size_t node) {
  return visit_facet(dimension, nodes, [&](auto shape) {
    const auto& at = decltype(shape)::node_positions[node];
    Eigen::Vector2d xi = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < at.size(); ++i) xi[static_cast<Eigen::Index>(i)] = at[i];
    return xi;
  });
}

double bend_of(int dimension, const FacetPlaces& facet) {
  const std::size_t corners = facet_corners(dimension, facet.size());
  double bend = 0.0;
  for (std::size_t a = corners; a < facet.size(); ++a) {
    const auto [one, other] = ends_of_edge(a, corners);
    bend = std::max(bend, (facet[a] - 0.5 * (facet[one] + facet[other])).norm());
  }
  return bend;
}

}  // namespace mortise
