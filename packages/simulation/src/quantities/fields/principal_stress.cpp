#include "quantities/fields/principal_stress.hpp"

#include <Eigen/Eigenvalues>

namespace mortise {

std::array<PrincipalStress, 3> principal_stresses(const Matrix3& stress) {
  if (!stress.allFinite()) return {};
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(stress);
  std::array<PrincipalStress, 3> principal;
  for (int i = 0; i < 3; ++i) {
    const int ascending = 2 - i;
    principal[static_cast<std::size_t>(i)].value = solver.eigenvalues()(ascending);
    for (int k = 0; k < 3; ++k) principal[static_cast<std::size_t>(i)].direction[static_cast<std::size_t>(k)] = solver.eigenvectors()(k, ascending);
  }
  return principal;
}

Matrix3 tensor_of(const double* components, int count) {
  Matrix3 tensor = Matrix3::Zero();
  for (int i = 0; i < 3; ++i) tensor(i, i) = components[i];
  tensor(0, 1) = tensor(1, 0) = components[3];
  if (count < 6) return tensor;
  tensor(1, 2) = tensor(2, 1) = components[4];
  tensor(0, 2) = tensor(2, 0) = components[5];
  return tensor;
}

}  // namespace mortise
