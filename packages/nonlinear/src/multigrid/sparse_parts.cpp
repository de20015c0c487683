#include "multigrid/sparse_parts.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <map>
#include <vector>

#include "mortise/core/column_map.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {

namespace {

/// Imported to the column map of A from its domain.
Vector of_columns(const Matrix& A, const Vector& marks) {
  Vector result(A.getColMap());
  result.doImport(marks, Import(marks.getMap(), A.getColMap()), Tpetra::INSERT);
  return result;
}

/// The rows of A whose ids are in `rows`, without entries for whose local columns `column_of` gives a negative one of `columns`.
/// @param importer  of the domain to the columns; null: not known
template <class ColumnOf>
RCP<const Matrix> part(const Matrix& A, const RCP<const Map>& rows, const RCP<const Map>& columns, const RCP<const Map>& domain,
                       const RCP<const Import>& importer, const ColumnOf& column_of) {
  const auto local = A.getLocalMatrixHost();
  const std::size_t count = local_id_count(*rows);
  Teuchos::ArrayRCP<std::size_t> starts(count + 1, 0);
  std::vector<LocalOrdinal> indices;
  std::vector<double> values;
  for (std::size_t row = 0; row < count; ++row) {
    const auto entries = local.rowConst(A.getRowMap()->getLocalElement(rows->getGlobalElement(static_cast<LocalOrdinal>(row))));
    for (LocalOrdinal k = 0; k < entries.length; ++k)
      if (const LocalOrdinal column = column_of(entries.colidx(k)); column >= 0) {
        indices.push_back(column);
        values.push_back(entries.value(k));
      }
    starts[row + 1] = indices.size();
  }
  const auto result = rcp(new Matrix(rows, columns, starts, Teuchos::arcpClone<LocalOrdinal>(Teuchos::arrayViewFromVector(indices)),
                                     Teuchos::arcpClone<double>(Teuchos::arrayViewFromVector(values))));
  result->expertStaticFillComplete(domain, rows, importer);
  return result;
}

}  // namespace

RCP<const Matrix> columns_of_identity_plus(const Matrix& A, const RCP<const Map>& chosen) {
  const RCP<const Map> domain = A.getDomainMap();
  Vector marks(domain);
  std::vector<std::size_t> sizes(local_row_count(A), 0);
  const auto local = A.getLocalMatrixHost();
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) sizes[row] = local.rowConst(row).length;
  for (const GlobalOrdinal id : local_ids(*chosen)) {
    marks.replaceGlobalValue(id, 1.0);
    ++sizes[A.getRowMap()->getLocalElement(id)];
  }
  const Vector column_marks = of_columns(A, marks);
  const auto is_chosen = column_marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto rows = A.getRowMap()->getLocalMap(), columns = A.getColMap()->getLocalMap();
  Matrix result(A.getRowMap(), Teuchos::arrayViewFromVector(sizes));
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
    const auto entries = local.rowConst(row);
    for (LocalOrdinal k = 0; k < entries.length; ++k) {
      if (is_chosen(entries.colidx(k), 0) == 0.0) continue;
      const GlobalOrdinal column = columns.getGlobalElement(entries.colidx(k));
      const double value = entries.value(k);
      result.insertGlobalValues(rows.getGlobalElement(row), 1, &value, &column);
    }
  }
  const double one = 1.0;
  for (const GlobalOrdinal id : local_ids(*chosen)) result.insertGlobalValues(id, 1, &one, &id);
  result.fillComplete(chosen, A.getRangeMap());
  return rcp(new const Matrix(std::move(result)));
}

RCP<Matrix> sum(const Matrix& A, const Matrix& B) { return Tpetra::MatrixMatrix::add(1.0, false, A, 1.0, false, B); }

RCP<Matrix> sum_without_zeros(const Matrix& A, const Matrix& B) {
  const auto of_b_ids = local_ids(*B.getColMap());
  const RCP<const Map> columns =
      A.getComm()->getSize() == 1 ? A.getColMap() : with_further_columns(*A.getColMap(), {of_b_ids.begin(), of_b_ids.end()});
  const auto a = A.getLocalMatrixHost(), b = B.getLocalMatrixHost();
  std::vector<LocalOrdinal> column_of_b(local_id_count(*B.getColMap()));
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

RCP<const Map> marked_ids(const Vector& marks) {
  const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<GlobalOrdinal> ids;
  for (std::size_t place = 0; place < marks.getLocalLength(); ++place)
    if (mark(place, 0) != 0.0) ids.push_back(marks.getMap()->getGlobalElement(static_cast<LocalOrdinal>(place)));
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new const Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, marks.getMap()->getComm()));
}

Vector marked_and_neighbours(const Matrix& A, const Vector& marks, int dimension) {
  const Vector column_marks = of_columns(A, marks);
  const auto is_marked = column_marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto local = A.getLocalMatrixHost();
  Vector result(marks, Teuchos::Copy);
  const auto mark = result.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal first = 0; first < local.numRows(); first += dimension) {
    bool is_one = false;
    for (LocalOrdinal row = first; row < first + dimension && !is_one; ++row) {
      is_one = mark(row, 0) != 0.0;
      const auto entries = local.rowConst(row);
      for (LocalOrdinal k = 0; k < entries.length && !is_one; ++k) is_one = entries.value(k) != 0.0 && is_marked(entries.colidx(k), 0) != 0.0;
    }
    for (LocalOrdinal row = first; row < first + dimension; ++row) mark(row, 0) = is_one ? 1.0 : 0.0;
  }
  return result;
}

RCP<const Matrix> marked_columns(const Matrix& A, const Vector& marks) {
  const Vector column_marks = of_columns(A, marks);
  const auto is_marked = column_marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  return part(A, A.getRowMap(), A.getColMap(), A.getDomainMap(), A.getGraph()->getImporter(),
              [&](LocalOrdinal column) { return is_marked(column, 0) != 0.0 ? column : -1; });
}

RCP<const Matrix> rows(const Matrix& A, const RCP<const Map>& chosen) {
  return part(A, chosen, A.getColMap(), A.getDomainMap(), A.getGraph()->getImporter(), [](LocalOrdinal column) { return column; });
}

RCP<const Matrix> block(const Matrix& A, const RCP<const Map>& chosen) {
  const auto columns = A.getColMap()->getLocalMap(), chosen_columns = chosen->getLocalMap();
  return part(A, chosen, chosen, chosen, Teuchos::null,
              [&](LocalOrdinal column) { return chosen_columns.getLocalElement(columns.getGlobalElement(column)); });
}

}  // namespace mortise::detail
