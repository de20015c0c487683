#pragma once
// Checks before and after every solve, whichever solver did it.

#include <string>

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// Collective: throws StepFailure(linear_solver) if the matrix or b holds NaN or Inf. Returns |b|.
double check_finite(const Matrix& matrix, const Vector& b, const std::string& solver);

/// r = b - A x; returns |r|.
double true_residual(const Operator& matrix, const Vector& b, const Vector& x, Vector& r);

/// |A|, the largest sum of a row's absolute values over all ranks: the norm that belongs to the largest component of vectors. Collective.
double largest_row_sum(const Matrix& matrix);

/// Normwise backward error |r| / (|A| |x| + |b|) in the maximum norm (Rigal and Gaches 1967): the least relative change of A and b of which x is the
/// exact solution. A stable factorisation leaves round-off here, whatever the condition of A; |r| / |b| it leaves as large as round-off times
/// |A| |x| / |b|. Collective.
/// @param matrix_norm  largest_row_sum(A)
double backward_error(double matrix_norm, const Vector& b, const Vector& x, const Vector& r);

}  // namespace mortise::detail
