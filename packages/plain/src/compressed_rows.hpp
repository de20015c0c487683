#pragma once
// Matrices in compressed rows of global columns.

#include <cstdint>
#include <vector>

#include "mortise/core/types.hpp"
#include "mortise/plain/mortise.h"

namespace mortise {

/// The rows of a rank.
struct CompressedRows {
  std::vector<std::int64_t> starts, columns;
  std::vector<double> values;

  /// The arrays as hosts get them: valid as long as they stay.
  mortise_matrix view() const;
};

/// The rows of a matrix that is indexed by local columns.
CompressedRows compressed_rows(const Matrix& matrix);

}  // namespace mortise
