#pragma once
// Eigenvalues and eigenvectors of a symmetric 3x3 tensor.

#include <Eigen/Core>
#include <cmath>

#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// b = sum_a values(a) n_a n_a^T with n_a = vectors.col(a), orthonormal to round-off also for equal and nearly equal values. In no order.
struct Spectrum {
  Eigen::Vector3d values;
  Matrix3 vectors;
};

/// Jacobi's rotations (Golub, Van Loan, Matrix Computations, 8.5): in turn each off-diagonal component is rotated away, until all are round-off of
/// the diagonal ones. It converges quadratically; nearly diagonal b takes a sweep or two.
inline Spectrum jacobi_rotations(Matrix3 b) {
  Matrix3 vectors = Matrix3::Identity();
  constexpr double negligible = 1e-34;  // the square of a share below round-off
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < 16; ++sweep) {
    rotated = false;
    for (int r = 2; r >= 0; --r) {
      const int p = r == 0 ? 1 : 0, q = r == 2 ? 1 : 2;
      if (!(b(p, q) * b(p, q) > negligible * std::abs(b(p, p) * b(q, q)))) continue;
      rotated = true;
      // tan of the smaller angle of rotation: b_pq t^2 + (b_qq - b_pp) t - b_pq = 0.
      const double difference = b(q, q) - b(p, p);
      const double tangent = 2.0 * b(p, q) / (difference + std::copysign(std::sqrt(difference * difference + 4.0 * b(p, q) * b(p, q)), difference));
      const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
      b(p, p) -= tangent * b(p, q);
      b(q, q) += tangent * b(p, q);
      b(p, q) = b(q, p) = 0.0;
      const double rp = b(r, p), rq = b(r, q);
      b(r, p) = b(p, r) = cosine * rp - sine * rq;
      b(r, q) = b(q, r) = sine * rp + cosine * rq;
      const Eigen::Vector3d column = vectors.col(p);
      vectors.col(p) = cosine * column - sine * vectors.col(q);
      vectors.col(q) = sine * column + cosine * vectors.col(q);
    }
  }
  return {b.diagonal(), vectors};
}

/// Where b_13 = b_23 = 0 (all plane and axisymmetric states) one Jacobi rotation is the answer.
inline Spectrum spectral_decomposition(const Matrix3& b) {
  if (b(0, 2) != 0.0 || b(1, 2) != 0.0) return jacobi_rotations(b);
  Spectrum spectrum{b.diagonal(), Matrix3::Identity()};
  if (b(0, 1) == 0.0) return spectrum;
  // tan of the smaller angle of rotation: t^2 + 2 theta t - 1 = 0, theta = (b_22 - b_11) / (2 b_12).
  const double theta = 0.5 * (b(1, 1) - b(0, 0)) / b(0, 1);
  const double tangent = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
  spectrum.values(0) -= tangent * b(0, 1);
  spectrum.values(1) += tangent * b(0, 1);
  spectrum.vectors(0, 0) = spectrum.vectors(1, 1) = cosine;
  spectrum.vectors(0, 1) = sine;
  spectrum.vectors(1, 0) = -sine;
  return spectrum;
}

}  // namespace mortise
