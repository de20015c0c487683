#pragma once
// Eigenvalues and eigenvectors of a symmetric 3x3 tensor.

#include <Eigen/Eigenvalues>
#include <cmath>

#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// b = sum_a values(a) n_a n_a^T with n_a = vectors.col(a), orthonormal to round-off also for equal and nearly equal values. In no order.
struct Spectrum {
  Eigen::Vector3d values;
  Matrix3 vectors;
};

/// Where b_13 = b_23 = 0 (all plane and axisymmetric states) one Jacobi rotation is the answer.
inline Spectrum spectral_decomposition(const Matrix3& b) {
  if (b(0, 2) != 0.0 || b(1, 2) != 0.0) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(b);
    return {solver.eigenvalues(), solver.eigenvectors()};
  }
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
