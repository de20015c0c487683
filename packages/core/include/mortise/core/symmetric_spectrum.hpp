#pragma once
// Eigenvalues and eigenvectors of symmetric matrices of any size. Eigen's solver is compiled once, not wherever one is asked for.

#include <Eigen/Core>

namespace mortise {

/// A = V diag(values) V^T.
struct SymmetricSpectrum {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< V, orthonormal columns in the order of the values
};

/// @param A  [n x n], symmetric; only its lower triangle is read
SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A);

}  // namespace mortise
