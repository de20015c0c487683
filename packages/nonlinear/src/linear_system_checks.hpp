#pragma once
// What every solve is asked before and after, whichever solver did it.

#include <string>

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// Collective: throws StepFailure(linear_solver) if the matrix or b holds NaN or Inf. Returns |b|.
double check_finite(const Matrix& matrix, const Vector& b, const std::string& solver);

/// r = b - A x; returns |r|.
double true_residual(const Matrix& matrix, const Vector& b, const Vector& x, Vector& r);

}  // namespace mortise::detail
