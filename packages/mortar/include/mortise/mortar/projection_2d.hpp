#pragma once
// Projections between a slave and a master facet in 2D, linear or quadratic, templated on the scalar (double, or a Sacado type for derivatives).

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "mortise/core/error.hpp"
#include "mortise/shape/line2.hpp"
#include "mortise/shape/line3.hpp"

namespace mortise {

template <class S>
using Point2 = std::array<S, 2>;

/// Shape of a line of so many nodes.
template <int nodes>
using LineShape = std::conditional_t<nodes == 2, Line2, Line3>;

/// Slave facet x(xi) = sum N_a x_a with the field n(xi) = sum N_a n_a of its (unit) nodal normals, which is not normalised.
template <class S, int nodes = 2>
struct SlaveLine {
  std::array<Point2<S>, nodes> x;       ///< nodes, ends first
  std::array<Point2<S>, nodes> normal;  ///< unit normals at them
};

/// Master facet y(eta) = sum N_l y_l.
template <class S, int nodes = 2>
struct MasterLine {
  std::array<Point2<S>, nodes> y;  ///< nodes, ends first
};

/// a x b, the third component.
template <class S>
S cross(const Point2<S>& a, const Point2<S>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// a - b
template <class S>
Point2<S> difference(const Point2<S>& a, const Point2<S>& b) {
  return {S(a[0] - b[0]), S(a[1] - b[1])};
}

/// sum c_a v_a
template <class S, class Coefficient, std::size_t nodes>
Point2<S> combine(const std::array<Coefficient, nodes>& coefficients, const std::array<Point2<S>, nodes>& vectors) {
  Point2<S> sum = {S(coefficients[0] * vectors[0][0]), S(coefficients[0] * vectors[0][1])};
  for (std::size_t a = 1; a < nodes; ++a)
    for (int i = 0; i < 2; ++i) sum[i] += coefficients[a] * vectors[a][i];
  return sum;
}

/// sum N_a(xi) v_a
template <class S, std::size_t nodes>
Point2<S> interpolate(const std::array<Point2<S>, nodes>& vectors, const S& xi) {
  return combine(LineShape<nodes>::values(xi), vectors);
}

/// sum dN_a/dxi v_a
template <class S, std::size_t nodes>
Point2<S> slope(const std::array<Point2<S>, nodes>& vectors, const S& xi) {
  return combine(LineShape<nodes>::gradients(xi), vectors);
}

/// Where the normal field of a slave facet meets a point, clipped to the facet.
struct ClippedProjection {
  double xi = 0.0;      ///< in [-1, 1]
  bool inside = false;  ///< strictly between the ends; only then xi moves with the nodes
};

/// The xi of the slave facet whose n(xi) points at y:  F(xi) = (y - x(xi)) x n(xi) = 0, clipped to [-1, 1].
/// F has the end values f_a = (y - x_a) x n_a and f_b. The neighbouring facets find the same values at the shared node, so no point falls between two
/// facets or counts twice. F grows with xi where the field has not crossed itself; then
///   f_a >= 0: before the first node,   f_b <= 0: behind the second,   f_a < 0 < f_b: a root inside.
/// Linear facets:  F = A xi^2 + B xi + C,  B = (f_b - f_a) / 2 > 0,  xi = C / q,  q = -(B + sqrt(B^2 - 4 A C)) / 2   (q never cancels; F'(xi) > 0
/// there). Of quadratic ones F is of degree 4.
/// No value: the point lies behind the place where the normals of the facet cross.
template <int nodes>
std::optional<ClippedProjection> project_back(const SlaveLine<double, nodes>& slave, const Point2<double>& y) {
  const double f_a = cross(difference(y, slave.x[0]), slave.normal[0]);
  const double f_b = cross(difference(y, slave.x[1]), slave.normal[1]);
  if (f_a >= 0.0 && f_b <= 0.0) return std::nullopt;
  if (f_a >= 0.0) return ClippedProjection{-1.0, false};
  if (f_b <= 0.0) return ClippedProjection{1.0, false};
  if constexpr (nodes == 2) {
    const double A = -0.25 * cross(difference(slave.x[1], slave.x[0]), difference(slave.normal[1], slave.normal[0]));
    const double B = 0.5 * (f_b - f_a), C = 0.5 * (f_a + f_b) - A;
    const double q = -0.5 * (B + std::sqrt(std::fmax(B * B - 4.0 * A * C, 0.0)));
    const double xi = std::fmin(std::fmax(C / q, -1.0), 1.0);
    return ClippedProjection{xi, true};
  } else {
    const auto F = [&](double xi) { return cross(difference(y, interpolate(slave.x, xi)), interpolate(slave.normal, xi)); };
    std::uintmax_t most = 200;
    const auto [low, high] = boost::math::tools::toms748_solve(F, -1.0, 1.0, f_a, f_b, boost::math::tools::eps_tolerance<double>(), most);
    return ClippedProjection{0.5 * (low + high), true};
  }
}

/// The root of project_back with its derivatives. One Newton step in S from the root as a constant is exact to first order:
///   xi - F(xi) / F'(xi),  dxi = -dF / F'.
/// A second one, from there, is exact to third order.
template <class S, int nodes>
S lift_root(const SlaveLine<S, nodes>& slave, const Point2<S>& y, const S& root) {
  const Point2<S> offset = difference(y, interpolate(slave.x, root)), normal = interpolate(slave.normal, root);
  const S F = cross(offset, normal);
  const S F_xi = cross(offset, slope(slave.normal, root)) - cross(slope(slave.x, root), normal);
  return root - F / F_xi;
}

/// Where a line through x along n (any length) meets the line of a master facet: x + distance n = y(eta).
template <class S>
struct MasterProjection {
  S eta;       ///< coordinate of the master facet
  S distance;  ///< along n, in multiples of its length
};

/// The master facet must not be parallel to n. A quadratic one: (y(eta) - x) x n = a eta^2 + b eta + c = 0, of whose roots the one that follows the
/// facet's direction of travel, eta = -2 c / (b + sqrt(b^2 - 4 a c)).
/// @throws StepFailure (projection) where the line misses a quadratic facet and its continuation
template <class S, int nodes>
MasterProjection<S> project_onto(const MasterLine<S, nodes>& master, const Point2<S>& x, const Point2<S>& n) {
  const Point2<S> half = {S(0.5 * (master.y[1][0] - master.y[0][0])), S(0.5 * (master.y[1][1] - master.y[0][1]))};
  const Point2<S> middle = {S(0.5 * (master.y[0][0] + master.y[1][0])), S(0.5 * (master.y[0][1] + master.y[1][1]))};
  if constexpr (nodes == 2) {
    const Point2<S> offset = difference(middle, x);
    const S scale = cross(half, n);
    return {S(-cross(offset, n) / scale), S(-cross(offset, half) / scale)};
  } else {
    using std::sqrt;
    const S a = cross(difference(middle, master.y[2]), n), b = cross(half, n), c = cross(difference(master.y[2], x), n);
    const S squared = b * b - 4.0 * a * c;
    if (!(squared > 0.0))
      throw StepFailure(FailureKind::projection, "a point of a slave facet cannot be projected on a master facet, which is too curved");
    const S eta = -2.0 * c / (b + sqrt(squared));
    const Point2<S> offset = difference(interpolate(master.y, eta), x);
    return {eta, S((offset[0] * n[0] + offset[1] * n[1]) / (n[0] * n[0] + n[1] * n[1]))};
  }
}

}  // namespace mortise
