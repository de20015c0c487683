#include "rotation_vector.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace mortise {
namespace {

using Eigen::Vector3d;

/// A function of s = |theta|^2 and its first two derivatives with respect to s.
struct Coefficient {
  double value, first, second;
};

/// sum_k (-s)^k / (2 k + offset)! for s < 1: the terms left out are below round-off.
Coefficient series(double s, int offset) {
  Coefficient sum{};
  double factorial = 1.0;
  for (int n = 2; n <= offset; ++n) factorial *= n;
  double power = 1.0, before = 0.0, two_before = 0.0;  // s^k, s^(k-1), s^(k-2)
  for (int k = 0; k <= 10; ++k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    sum.value += sign * power / factorial;
    sum.first += sign * k * before / factorial;
    sum.second += sign * k * (k - 1) * two_before / factorial;
    two_before = before;
    before = power;
    power *= s;
    factorial *= (2 * k + 1 + offset) * (2 * k + 2 + offset);
  }
  return sum;
}

/// a = sin(t) / t and b = (1 - cos(t)) / t^2 of t^2 = s:
///   a' = (cos(t) - a) / 2s,  a'' = -(a + 6 a') / 4s,   b' = (a - 2 b) / 2s,  b'' = (a' - 4 b') / 2s.
std::array<Coefficient, 2> coefficients(double s) {
  if (s < 1.0) return {series(s, 1), series(s, 2)};
  const double t = std::sqrt(s);
  Coefficient a{}, b{};
  a.value = std::sin(t) / t;
  a.first = (std::cos(t) - a.value) / (2.0 * s);
  a.second = -(a.value + 6.0 * a.first) / (4.0 * s);
  b.value = (1.0 - std::cos(t)) / s;
  b.first = (a.value - 2.0 * b.value) / (2.0 * s);
  b.second = (a.first - 4.0 * b.first) / (2.0 * s);
  return {a, b};
}

}  // namespace

// R x = x + a v + b w with v = theta x x and w = theta x (theta x x) = theta (theta . x) - s x, of which v is linear and w quadratic in theta.
Turned turn(const Vector3d& theta, const Vector3d& x) {
  const double s = theta.squaredNorm();
  const auto [a, b] = coefficients(s);
  const Vector3d v = theta.cross(x), w = theta * theta.dot(x) - s * x;
  std::array<Vector3d, 3> dv, dw;
  for (int k = 0; k < 3; ++k) {
    dv[k] = Vector3d::Unit(k).cross(x);
    dw[k] = Vector3d::Unit(k) * theta.dot(x) + theta * x[k] - 2.0 * theta[k] * x;
  }
  Turned turned;
  turned.value = x + a.value * v + b.value * w;
  for (int k = 0; k < 3; ++k) {
    turned.gradient[k] = a.value * dv[k] + b.value * dw[k] + 2.0 * theta[k] * (a.first * v + b.first * w);
    for (int l = 0; l < 3; ++l) {
      const double same = k == l ? 1.0 : 0.0;
      const Vector3d ddw = Vector3d::Unit(k) * x[l] + Vector3d::Unit(l) * x[k] - 2.0 * same * x;
      turned.curvature[k][l] = b.value * ddw + 2.0 * theta[k] * (a.first * dv[l] + b.first * dw[l]) +
                               2.0 * theta[l] * (a.first * dv[k] + b.first * dw[k]) + 2.0 * same * (a.first * v + b.first * w) +
                               4.0 * theta[k] * theta[l] * (a.second * v + b.second * w);
    }
  }
  return turned;
}

}  // namespace mortise
