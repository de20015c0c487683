#include "mortise/core/matrix_sum.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <vector>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise {

bool add_entries(const Matrix& rows, Matrix& sum) {
  bool have_places = true;
  std::vector<GlobalOrdinal> ids;
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(rows)); ++row) {
    Matrix::local_inds_host_view_type columns;
    Matrix::values_host_view_type values;
    rows.getLocalRowView(row, columns, values);
    if (columns.extent(0) == 0) continue;
    ids.clear();
    for (std::size_t k = 0; k < columns.extent(0); ++k) ids.push_back(rows.getColMap()->getGlobalElement(columns(k)));
    const auto count = static_cast<LocalOrdinal>(ids.size());
    if (sum.sumIntoGlobalValues(rows.getRowMap()->getGlobalElement(row), count, values.data(), ids.data()) != count) have_places = false;
  }
  return have_places;
}

}  // namespace mortise
