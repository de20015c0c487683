#pragma once
// Parts and sums of sparse matrices. All are collective.

#include "mortise/core/types.hpp"

namespace mortise::detail {

/// The columns of I + A whose ids are in `chosen`, which is the result's domain; each on the rank that owns it in A's.
RCP<const Matrix> columns_of_identity_plus(const Matrix& A, const RCP<const Map>& chosen);

/// A + B
RCP<Matrix> sum(const Matrix& A, const Matrix& B);

/// A + B, B with few entries, without entries of A that are 0, as those of prescribed rows and columns are.
RCP<Matrix> sum_without_zeros(const Matrix& A, const Matrix& B);

/// The ids at which `marks` is not 0, each on its owner.
RCP<const Map> marked_ids(const Vector& marks);

/// 1 at the rows of nodes, each of `dimension` rows one behind the other, that are marked or of which A couples one to a marked column, else 0.
Vector marked_and_neighbours(const Matrix& A, const Vector& marks, int dimension);

/// The columns of A in which `marks`, on A's domain, is not 0; the others are empty.
RCP<const Matrix> marked_columns(const Matrix& A, const Vector& marks);

/// The rows of A whose ids are in `chosen`, each on the rank that owns it in A; columns and domain are A's.
RCP<const Matrix> rows(const Matrix& A, const RCP<const Map>& chosen);

/// The rows and columns of A whose ids are in `chosen`, for a matrix none of whose entries couples ids of two ranks.
RCP<const Matrix> block(const Matrix& A, const RCP<const Map>& chosen);

}  // namespace mortise::detail
