#include "integrals/whole_facet.hpp"

#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "mortise/mortar/quadratic_facet.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/line3.hpp"
#include "mortise/shape/quadrature.hpp"
#include "mortise/shape/quadrilateral4.hpp"
#include "mortise/shape/quadrilateral8.hpp"
#include "mortise/shape/triangle3.hpp"
#include "mortise/shape/triangle6.hpp"

namespace mortise {
namespace {

void to_non_negative_basis(int dimension, WholeFacet& whole) {
  const NonNegativeBasis* basis = non_negative_basis(dimension, static_cast<std::size_t>(whole.weights.size()));
  if (basis == nullptr) return;
  whole.weights = FacetVector(basis->of_shape * whole.weights);
  if (whole.slope.size() > 0) whole.slope = Eigen::MatrixXd(basis->of_shape * whole.slope);
}

// int N_a s |x'| dxi, s = t or 2 pi r:   d(|x'|)/dx_b = N_b' x' / |x'|,   dr/dx_b = N_b e_r
template <class Shape>
WholeFacet of_line(const LinePoints& x, const InterfaceMeasure& measure, bool derivatives) {
  constexpr int n = Shape::nodes;
  constexpr double two_pi = boost::math::double_constants::two_pi;
  static const std::vector<LinePoint> rule = gauss_legendre(n == 2 ? 2 : 5);  // |x'| of a straight line is constant
  WholeFacet whole;
  whole.weights = FacetVector::Zero(n);
  whole.slope.setZero(derivatives ? n : 0, derivatives ? 2 * n : 0);
  for (const LinePoint& point : rule) {
    const auto N = Shape::values(point.xi), G = Shape::gradients(point.xi);
    double along[2] = {0.0, 0.0}, radius = 0.0;
    for (int a = 0; a < n; ++a) {
      for (int i = 0; i < 2; ++i) along[i] += G[a] * x[a][i];
      radius += N[a] * x[a][0];
    }
    const double length = std::hypot(along[0], along[1]), size = measure.axisymmetric ? two_pi * radius : measure.thickness;
    for (int a = 0; a < n; ++a) {
      whole.weights[a] += point.weight * N[a] * size * length;
      for (int b = 0; b < n && derivatives; ++b) {
        for (int i = 0; i < 2; ++i) whole.slope(a, 2 * b + i) += point.weight * N[a] * size * G[b] * along[i] / length;
        if (measure.axisymmetric) whole.slope(a, 2 * b) += point.weight * N[a] * two_pi * N[b] * length;
      }
    }
  }
  to_non_negative_basis(2, whole);
  return whole;
}

// int N_a (X_xi x X_eta) dxi, X the projections on the plane. The rules are exact: degree 1 on a triangle of 3 nodes, 4 with 6; on quadrilaterals of
// 4 nodes degree 2 in each direction, 5 with 8.
template <class Shape>
WholeFacet on_plane(const AuxiliaryPlane& plane, const std::vector<CellPoint>& rule, bool derivatives) {
  constexpr int n = Shape::nodes;
  WholeFacet whole;
  whole.weights = FacetVector::Zero(n);
  whole.slope.setZero(derivatives ? n : 0, derivatives ? 3 * n : 0);
  for (const CellPoint& point : rule) {
    const auto N = Shape::values(point.position<2>());
    const auto G = Shape::gradients(point.position<2>());
    Eigen::Vector2d first = Eigen::Vector2d::Zero(), second = first;
    for (int a = 0; a < n; ++a) {
      first += G[a][0] * plane.slave[a].template head<2>();
      second += G[a][1] * plane.slave[a].template head<2>();
    }
    const double area = first.x() * second.y() - first.y() * second.x();
    for (int a = 0; a < n; ++a) {
      whole.weights[a] += point.weight * N[a] * area;
      for (int b = 0; b < n && derivatives; ++b) {
        whole.slope(a, 3 * b) += point.weight * N[a] * (G[b][0] * second.y() - G[b][1] * first.y());
        whole.slope(a, 3 * b + 1) += point.weight * N[a] * (G[b][1] * first.x() - G[b][0] * second.x());
      }
    }
  }
  if (derivatives) plane.to_global({plane.slave.begin(), plane.slave.end()}, whole.slope);
  to_non_negative_basis(3, whole);
  return whole;
}

}  // namespace

WholeFacet whole_facet(const LinePoints& x, const InterfaceMeasure& measure, bool derivatives) {
  return x.size() == 2 ? of_line<Line2>(x, measure, derivatives) : of_line<Line3>(x, measure, derivatives);
}

WholeFacet whole_facet(const AuxiliaryPlane& plane, bool derivatives) {
  static const std::vector<CellPoint> triangle = triangle_rule(1), triangle_of_6 = triangle_rule(7), square = quadrilateral_rule(2),
                                      square_of_8 = quadrilateral_rule(3);
  switch (plane.slave.size()) {
    case 3:
      return on_plane<Triangle3>(plane, triangle, derivatives);
    case 4:
      return on_plane<Quadrilateral4>(plane, square, derivatives);
    case 6:
      return on_plane<Triangle6>(plane, triangle_of_6, derivatives);
    default:
      return on_plane<Quadrilateral8>(plane, square_of_8, derivatives);
  }
}

}  // namespace mortise
