#pragma once
// Principal values of a stress.

#include <array>

#include "mortise/material/tensor_components.hpp"

namespace mortise {

/// A principal stress and its direction, of unit length; the sign of the direction has no meaning.
struct PrincipalStress {
  double value = 0.0;
  std::array<double, 3> direction{};
};

/// The three of a symmetric tensor, the largest first.
std::array<PrincipalStress, 3> principal_stresses(const Matrix3& stress);

/// The symmetric tensor of components xx, yy, zz, xy and, if there are six of them, yz, xz.
Matrix3 tensor_of(const double* components, int count);

}  // namespace mortise
