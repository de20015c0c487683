#pragma once
// Projections between a slave and a master facet in 2D, templated on the scalar (double, or a Sacado type for derivatives).

#include <array>
#include <cmath>
#include <optional>

namespace mortise {

template <class S>
using Point2 = std::array<S, 2>;

/// Slave facet x(xi) = N_a x_a + N_b x_b with the field n(xi) = N_a n_a + N_b n_b of its (unit) nodal normals, which is not normalised.
template <class S>
struct SlaveLine {
  std::array<Point2<S>, 2> x;
  std::array<Point2<S>, 2> normal;
};

/// Master facet y(eta) = N_0 y_0 + N_1 y_1.
template <class S>
struct MasterLine {
  std::array<Point2<S>, 2> y;
};

template <class S>
S cross(const Point2<S>& a, const Point2<S>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

template <class S>
Point2<S> difference(const Point2<S>& a, const Point2<S>& b) {
  return {S(a[0] - b[0]), S(a[1] - b[1])};
}

/// a (1 - xi) / 2 + b (1 + xi) / 2
template <class S>
Point2<S> interpolate(const Point2<S>& a, const Point2<S>& b, const S& xi) {
  const S first = 0.5 * (1.0 - xi), second = 0.5 * (1.0 + xi);
  return {S(first * a[0] + second * b[0]), S(first * a[1] + second * b[1])};
}

/// Where the normal field of a slave facet meets a point, clipped to the facet.
struct ClippedProjection {
  double xi = 0.0;
  bool inside = false;  ///< strictly between the ends; only then xi moves with the nodes
};

/// The xi of the slave facet whose n(xi) points at y:  F(xi) = (y - x(xi)) x n(xi) = 0, clipped to [-1, 1].
/// F is quadratic with the end values f_a = (y - x_a) x n_a and f_b, which are what the neighbouring facets find at the shared node too, so no
/// point falls between two facets or counts twice. F grows with xi where the field has not crossed itself; then
///   f_a >= 0: before the first node,   f_b <= 0: behind the second,   f_a < 0 < f_b: one root inside, and
///   F = A xi^2 + B xi + C,  B = (f_b - f_a) / 2 > 0,  xi = C / q,  q = -(B + sqrt(B^2 - 4 A C)) / 2   (q never cancels; F'(xi) > 0 there).
/// No value: the point lies behind the place where the normals of the facet cross.
inline std::optional<ClippedProjection> project_back(const SlaveLine<double>& slave, const Point2<double>& y) {
  const double f_a = cross(difference(y, slave.x[0]), slave.normal[0]);
  const double f_b = cross(difference(y, slave.x[1]), slave.normal[1]);
  if (f_a >= 0.0 && f_b <= 0.0) return std::nullopt;
  if (f_a >= 0.0) return ClippedProjection{-1.0, false};
  if (f_b <= 0.0) return ClippedProjection{1.0, false};
  const double A = -0.25 * cross(difference(slave.x[1], slave.x[0]), difference(slave.normal[1], slave.normal[0]));
  const double B = 0.5 * (f_b - f_a), C = 0.5 * (f_a + f_b) - A;
  const double q = -0.5 * (B + std::sqrt(std::fmax(B * B - 4.0 * A * C, 0.0)));
  const double xi = std::fmin(std::fmax(C / q, -1.0), 1.0);
  return ClippedProjection{xi, true};
}

/// The root `xi` of project_back with its derivatives: one Newton step in S from the root as a constant is exact to first order,
///   xi - F(xi) / F'(xi),  dxi = -dF / F'.
template <class S>
S lift_root(const SlaveLine<S>& slave, const Point2<S>& y, double xi) {
  const S root(xi);
  const Point2<S> offset = difference(y, interpolate(slave.x[0], slave.x[1], root));
  const Point2<S> normal = interpolate(slave.normal[0], slave.normal[1], root);
  const S F = cross(offset, normal);
  const S slope = 0.5 * cross(offset, difference(slave.normal[1], slave.normal[0])) - 0.5 * cross(difference(slave.x[1], slave.x[0]), normal);
  return root - F / slope;
}

/// Where a line through x along n (any length) meets the line of a master facet: x + distance n = y(eta).
template <class S>
struct MasterProjection {
  S eta, distance;
};

/// The master facet must not be parallel to n.
template <class S>
MasterProjection<S> project_onto(const MasterLine<S>& master, const Point2<S>& x, const Point2<S>& n) {
  const Point2<S> half = {S(0.5 * (master.y[1][0] - master.y[0][0])), S(0.5 * (master.y[1][1] - master.y[0][1]))};
  const Point2<S> offset = {S(0.5 * (master.y[0][0] + master.y[1][0]) - x[0]), S(0.5 * (master.y[0][1] + master.y[1][1]) - x[1])};
  const S scale = cross(half, n);
  return {S(-cross(offset, n) / scale), S(-cross(offset, half) / scale)};
}

}  // namespace mortise
