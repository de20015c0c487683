#include "compressed_rows.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

mortise_matrix CompressedRows::view() const { return {static_cast<std::int64_t>(starts.size()) - 1, starts.data(), columns.data(), values.data()}; }

CompressedRows compressed_rows(const Matrix& matrix) {
  CompressedRows result{{0}, {}, {}};
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(matrix)); ++row) {
    Matrix::local_inds_host_view_type columns;
    Matrix::values_host_view_type values;
    matrix.getLocalRowView(row, columns, values);
    for (std::size_t k = 0; k < columns.extent(0); ++k) {
      result.columns.push_back(matrix.getColMap()->getGlobalElement(columns(k)));
      result.values.push_back(values(k));
    }
    result.starts.push_back(static_cast<std::int64_t>(result.columns.size()));
  }
  return result;
}

}  // namespace mortise
