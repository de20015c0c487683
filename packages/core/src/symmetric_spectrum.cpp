#include "mortise/core/symmetric_spectrum.hpp"

#include <Eigen/Eigenvalues>

namespace mortise {

SymmetricSpectrum symmetric_spectrum(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace mortise
