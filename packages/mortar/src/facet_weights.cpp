// The weights of a facet's nodes in the reference configuration.

#include "mortise/shape/quadrature.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "slave_surface.hpp"

namespace mortise {

constexpr double two_pi = 6.283185307179586476925286766559;

FacetVector facet_weights(const FacetPoints<2>& x, const InterfaceMeasure& measure) {
  const double length = (x[1] - x[0]).norm();
  FacetVector weights = FacetVector::Constant(2, 0.5 * length * measure.thickness);
  if (measure.axisymmetric) weights << two_pi * length * (x[0].x() / 3.0 + x[1].x() / 6.0), two_pi * length * (x[0].x() / 6.0 + x[1].x() / 3.0);
  return weights;
}

// A third of a triangle's area each. 3 x 3 points on quadrilaterals: exact where they are flat.
FacetVector facet_weights(const FacetPoints<3>& x, const InterfaceMeasure&) {
  if (x.size() == 3) return FacetVector::Constant(3, central_normal(x).norm() / 6.0);
  FacetVector weights = FacetVector::Zero(4);
  for (const CellPoint& point : quadrilateral_rule(3)) {
    const std::array<double, 2> xi = {point.xi[0], point.xi[1]};
    const auto N = Quadrilateral4::values(xi);
    const auto G = Quadrilateral4::gradients(xi);
    Eigen::Vector3d along = Eigen::Vector3d::Zero(), across = Eigen::Vector3d::Zero();
    for (int a = 0; a < 4; ++a) {
      along += G[a][0] * x[a];
      across += G[a][1] * x[a];
    }
    const double area = point.weight * along.cross(across).norm();
    for (int a = 0; a < 4; ++a) weights[a] += N[a] * area;
  }
  return weights;
}

}  // namespace mortise
