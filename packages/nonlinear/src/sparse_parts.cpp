#include "sparse_parts.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <map>
#include <vector>

#include "mortise/core/column_map.hpp"

namespace mortise::detail {

RCP<Matrix> beyond_identity(const Matrix& A, const Matrix& marked) {
  const auto local = A.getLocalMatrixHost();
  const auto marks = marked.getLocalMatrixHost();
  std::vector<std::size_t> sizes(static_cast<std::size_t>(local.numRows()), 0);
  for (LocalOrdinal row = 0; row < local.numRows(); ++row)
    if (marks.rowConst(row).length > 0) sizes[row] = static_cast<std::size_t>(local.rowConst(row).length) + 1;
  const auto rows = A.getRowMap()->getLocalMap(), columns = A.getColMap()->getLocalMap();
  const auto result = rcp(new Matrix(A.getRowMap(), Teuchos::arrayViewFromVector(sizes)));  // by global ids: A may have no column for its diagonal
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
    if (sizes[row] == 0) continue;
    const GlobalOrdinal id = rows.getGlobalElement(row);
    const auto add = [&](GlobalOrdinal column, double value) { result->insertGlobalValues(id, 1, &value, &column); };
    const auto entries = local.rowConst(row);
    for (LocalOrdinal k = 0; k < entries.length; ++k) add(columns.getGlobalElement(entries.colidx(k)), entries.value(k));
    add(id, -1.0);
  }
  result->fillComplete(A.getDomainMap(), A.getRangeMap());
  return result;
}

RCP<Matrix> sum(const Matrix& A, const Matrix& B) { return Tpetra::MatrixMatrix::add(1.0, false, A, 1.0, false, B); }

RCP<Matrix> sum_without_zeros(const Matrix& A, const Matrix& B) {
  const auto of_b_ids = B.getColMap()->getNodeElementList();
  const RCP<const Map> columns =
      A.getComm()->getSize() == 1 ? A.getColMap() : with_further_columns(*A.getColMap(), {of_b_ids.begin(), of_b_ids.end()});
  const auto a = A.getLocalMatrixHost(), b = B.getLocalMatrixHost();
  std::vector<LocalOrdinal> column_of_b(B.getColMap()->getNodeNumElements());
  for (std::size_t c = 0; c < column_of_b.size(); ++c)
    column_of_b[c] = columns->getLocalElement(B.getColMap()->getGlobalElement(static_cast<LocalOrdinal>(c)));
  std::map<LocalOrdinal, double> both;
  // Calls use(column, value) for the entries of a row, by ascending columns.
  const auto visit = [&](LocalOrdinal row, const auto& use) {
    const auto of_a = a.rowConst(row), of_b = b.rowConst(row);
    both.clear();
    for (LocalOrdinal k = 0; k < of_a.length; ++k) {
      if (of_a.value(k) == 0.0) continue;
      if (of_b.length == 0)
        use(of_a.colidx(k), of_a.value(k));
      else
        both[of_a.colidx(k)] += of_a.value(k);
    }
    for (LocalOrdinal k = 0; k < of_b.length; ++k) both[column_of_b[of_b.colidx(k)]] += of_b.value(k);
    for (const auto& [column, value] : both) use(column, value);
  };
  const auto rows = static_cast<std::size_t>(a.numRows());
  Matrix::local_graph_device_type::row_map_type::non_const_type starts("starts", rows + 1);
  for (std::size_t row = 0; row < rows; ++row) {
    std::size_t size = 0;
    visit(static_cast<LocalOrdinal>(row), [&](LocalOrdinal, double) { ++size; });
    starts(row + 1) = starts(row) + size;
  }
  Matrix::local_graph_device_type::entries_type::non_const_type entries("entries", starts(rows));
  Matrix::local_matrix_device_type::values_type values("values", starts(rows));
  std::size_t next = 0;
  for (std::size_t row = 0; row < rows; ++row)
    visit(static_cast<LocalOrdinal>(row), [&](LocalOrdinal column, double value) {
      entries(next) = column;
      values(next++) = value;
    });
  const auto result = rcp(new Matrix(A.getRowMap(), columns, starts, entries, values));
  result->expertStaticFillComplete(A.getDomainMap(), A.getRangeMap());
  return result;
}

RCP<const Matrix> columns(const Matrix& A, const RCP<const Map>& chosen) {
  Matrix injection(A.getDomainMap(), 1);
  for (const GlobalOrdinal id : chosen->getNodeElementList()) {
    const double one = 1.0;
    injection.insertGlobalValues(id, 1, &one, &id);
  }
  injection.fillComplete(chosen, A.getDomainMap());
  const auto result = rcp(new Matrix(A.getRowMap(), 0));
  Tpetra::MatrixMatrix::Multiply(A, false, injection, false, *result);
  return result;
}

RCP<const Matrix> rows(const RCP<const Matrix>& A, const RCP<const Map>& chosen) {
  return Tpetra::importAndFillCompleteCrsMatrix<Matrix>(A, Import(A->getRowMap(), chosen), A->getDomainMap(), chosen);
}

}  // namespace mortise::detail
