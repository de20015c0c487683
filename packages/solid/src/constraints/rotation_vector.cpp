#include "mortise/solid/rotation_vector.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

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

/// a = sin(t) / t, b = (1 - cos(t)) / t^2 and c = (t - sin(t)) / t^3 of t^2 = s. With c_0 = cos(t), c_1 = a, c_2 = b, c_3 = c:
///   c_n' = (c_n-1 - n c_n) / 2s,  c_n'' = (c_n-1' - (n + 2) c_n') / 2s,  c_0' = -a / 2.
std::array<Coefficient, 3> coefficients(double s) {
  if (s < 1.0) return {series(s, 1), series(s, 2), series(s, 3)};
  const double t = std::sqrt(s), a = std::sin(t) / t;
  std::array<Coefficient, 3> result{};
  Coefficient before{std::cos(t), -0.5 * a, 0.0};
  const double values[] = {a, (1.0 - std::cos(t)) / s, (1.0 - a) / s};
  for (int n = 1; n <= 3; ++n) {
    Coefficient& now = result[n - 1];
    now.value = values[n - 1];
    now.first = (before.value - n * now.value) / (2.0 * s);
    now.second = (before.first - (n + 2) * now.first) / (2.0 * s);
    before = now;
  }
  return result;
}

/// x + p v + q w with v = theta x x and w = theta x (theta x x) = theta (theta . x) - s x. In theta v is linear and w quadratic.
OfRotation combine(const Vector3d& theta, const Vector3d& x, const Coefficient& p, const Coefficient& q) {
  const double s = theta.squaredNorm();
  const Vector3d v = theta.cross(x), w = theta * theta.dot(x) - s * x;
  std::array<Vector3d, 3> dv, dw;
  for (int k = 0; k < 3; ++k) {
    dv[k] = Vector3d::Unit(k).cross(x);
    dw[k] = Vector3d::Unit(k) * theta.dot(x) + theta * x[k] - 2.0 * theta[k] * x;
  }
  OfRotation result;
  result.value = x + p.value * v + q.value * w;
  for (int k = 0; k < 3; ++k) {
    result.gradient[k] = p.value * dv[k] + q.value * dw[k] + 2.0 * theta[k] * (p.first * v + q.first * w);
    for (int l = 0; l < 3; ++l) {
      const double same = k == l ? 1.0 : 0.0;
      const Vector3d ddw = Vector3d::Unit(k) * x[l] + Vector3d::Unit(l) * x[k] - 2.0 * same * x;
      result.curvature[k][l] = q.value * ddw + 2.0 * theta[k] * (p.first * dv[l] + q.first * dw[l]) +
                               2.0 * theta[l] * (p.first * dv[k] + q.first * dw[k]) + 2.0 * same * (p.first * v + q.first * w) +
                               4.0 * theta[k] * theta[l] * (p.second * v + q.second * w);
    }
  }
  return result;
}

}  // namespace

// R x = x + a theta x x + b theta x (theta x x).
OfRotation turn(const Vector3d& theta, const Vector3d& x) {
  const auto [a, b, c] = coefficients(theta.squaredNorm());
  return combine(theta, x, a, b);
}

// T = 1 + b [theta]x + c [theta]x^2 (the derivative of the exponential; with [theta]x^2 = theta theta^T - s 1 also a 1 + b [theta]x + c theta
// theta^T).
Eigen::Matrix3d spin(const Vector3d& theta) {
  const auto [a, b, c] = coefficients(theta.squaredNorm());
  Eigen::Matrix3d T;
  for (int k = 0; k < 3; ++k) T.col(k) = combine(theta, Vector3d::Unit(k), b, c).value;
  return T;
}

// T^T = 1 - b [theta]x + c [theta]x^2.
OfRotation generalised_moment(const Vector3d& theta, const Vector3d& m) {
  const auto [a, b, c] = coefficients(theta.squaredNorm());
  return combine(theta, m, {-b.value, -b.first, -b.second}, c);
}

double least_spin(const Vector3d& theta, const std::array<bool, 3>& free) {
  const Eigen::Matrix3d T = spin(theta);
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> columns(3, std::count(free.begin(), free.end(), true));
  if (columns.cols() == 0) return 1.0;
  for (Eigen::Index k = 0, n = 0; k < 3; ++k)
    if (free[k]) columns.col(n++) = T.col(k);
  return columns.jacobiSvd().singularValues().minCoeff();
}

Vector3d spatial_moment(const Vector3d& theta, const Vector3d& generalised) {
  if (generalised.isZero(0.0)) return Vector3d::Zero();
  if (least_spin(theta, {true, true, true}) < smallest_spin) return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return spin(theta).transpose().partialPivLu().solve(generalised);
}

}  // namespace mortise
