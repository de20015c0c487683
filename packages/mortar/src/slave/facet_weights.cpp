// The weights of a facet's nodes in the reference configuration.

#include "mortise/shape/line3.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle6.hpp"
#include "slave/slave_surface.hpp"

namespace mortise {
namespace {

constexpr double two_pi = 6.283185307179586476925286766559;

// int N_a dA
template <class Shape>
FacetVector weights_of(const FacetPoints<3>& x, const std::vector<CellPoint>& rule) {
  FacetVector weights = FacetVector::Zero(Shape::nodes);
  for (const CellPoint& point : rule) {
    const auto N = Shape::values(point.position<2>());
    const auto G = Shape::gradients(point.position<2>());
    Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = Eigen::Vector3d::Zero();
    for (int a = 0; a < Shape::nodes; ++a) {
      along += G[a][0] * x[a];
      across += G[a][1] * x[a];
    }
    const double area = point.weight * along.cross(across).norm();
    for (int a = 0; a < Shape::nodes; ++a) weights[a] += N[a] * area;
  }
  return weights;
}

}  // namespace

FacetVector facet_weights(const FacetPoints<2>& x, const InterfaceMeasure& measure) {
  if (x.size() == 3) {
    FacetVector weights = FacetVector::Zero(3);
    constexpr int points = 5;
    for (const LinePoint& point : gauss_legendre(points)) {
      const auto N = Line3::values(point.xi), G = Line3::gradients(point.xi);
      const Eigen::Vector2d at = N[0] * x[0] + N[1] * x[1] + N[2] * x[2], along = G[0] * x[0] + G[1] * x[1] + G[2] * x[2];
      const double length = point.weight * along.norm() * (measure.axisymmetric ? two_pi * at.x() : measure.thickness);
      for (int a = 0; a < 3; ++a) weights[a] += N[a] * length;
    }
    return non_negative_basis(2, 3)->of_shape * weights;
  }
  const double length = (x[1] - x[0]).norm();
  FacetVector weights = FacetVector::Constant(2, 0.5 * length * measure.thickness);
  if (measure.axisymmetric) weights << two_pi * length * (x[0].x() / 3.0 + x[1].x() / 6.0), two_pi * length * (x[0].x() / 6.0 + x[1].x() / 3.0);
  return weights;
}

// A third of a triangle's area each. 3 x 3 points on quadrilaterals, 4 x 4 on quadratic ones: exact where they are flat.
FacetVector facet_weights(const FacetPoints<3>& x, const InterfaceMeasure&) {
  switch (x.size()) {
    case 3:
      return FacetVector::Constant(3, central_normal(x).norm() / 6.0);
    case 4:
      return weights_of<Quadrilateral4>(x, quadrilateral_rule(3));
    case 6:
      return non_negative_basis(3, 6)->of_shape * weights_of<Triangle6>(x, triangle_rule(7));
    default:
      return non_negative_basis(3, 8)->of_shape * weights_of<Quadrilateral8>(x, quadrilateral_rule(4));
  }
}

}  // namespace mortise
