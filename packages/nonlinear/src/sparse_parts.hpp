#pragma once
// Parts and sums of sparse matrices. All are collective.

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// A - I for a matrix that is the identity but for the rows in which `marked` has entries; those alone are kept.
RCP<Matrix> beyond_identity(const Matrix& A, const Matrix& marked);

/// A + B
RCP<Matrix> sum(const Matrix& A, const Matrix& B);

/// A + B, B with few entries, without entries of A that are 0, as those of prescribed rows and columns are.
RCP<Matrix> sum_without_zeros(const Matrix& A, const Matrix& B);

/// The columns of A whose ids are in `chosen`, which is the result's domain; each on the rank that owns it in A's.
RCP<const Matrix> columns(const Matrix& A, const RCP<const Map>& chosen);

/// The rows of A whose ids are in `chosen`, each on the rank that owns it in A.
RCP<const Matrix> rows(const RCP<const Matrix>& A, const RCP<const Map>& chosen);

}  // namespace mortise::detail
