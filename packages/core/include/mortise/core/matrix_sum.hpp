#pragma once
// Sums of sparse matrices whose entries have their place already.

#include "mortise/core/types.hpp"

namespace mortise {

/// sum += rows.
/// @param rows  filled; its rows are among those of `sum`
/// @param sum   open for changes
/// @return false if an entry has no place in `sum`; it is then left out
bool add_entries(const Matrix& rows, Matrix& sum);

}  // namespace mortise
