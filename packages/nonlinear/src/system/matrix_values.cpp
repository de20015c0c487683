#include "system/matrix_values.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <stdexcept>

namespace mortise::detail {
namespace {

RCP<const Vector> on_columns(const Graph& graph, const RCP<const Vector>& on_rows) {
  if (graph.getImporter().is_null()) return on_rows;
  const auto result = rcp(new Vector(graph.getColMap()));
  result->doImport(*on_rows, *graph.getImporter(), Tpetra::REPLACE);
  return result;
}

}  // namespace

bool same_entries(const Graph& a, const Graph& b) {
  if (&a == &b) return true;
  const auto u = a.getLocalGraphHost(), v = b.getLocalGraphHost();
  int same = a.getColMap()->locallySameAs(*b.getColMap()) && u.numRows() == v.numRows() && u.entries.extent(0) == v.entries.extent(0), everywhere = 0;
  for (std::size_t row = 0; same != 0 && row < u.row_map.extent(0); ++row) same = u.row_map(row) == v.row_map(row);
  for (std::size_t k = 0; same != 0 && k < u.entries.extent(0); ++k) same = u.entries(k) == v.entries(k);
  Teuchos::reduceAll(*a.getComm(), Teuchos::REDUCE_MIN, same, Teuchos::outArg(everywhere));
  return everywhere != 0;
}

DirichletElimination::DirichletElimination(const Graph& graph, const std::vector<LocalOrdinal>& rows) : rows_(rows) {
  const auto flags = rcp(new Vector(graph.getRowMap()));
  for (const LocalOrdinal row : rows) flags->replaceLocalValue(row, 1.0);
  const RCP<const Vector> column_flags = on_columns(graph, flags);
  const auto fixed_row = flags->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto fixed_column = column_flags->getLocalViewHost(Tpetra::Access::ReadOnly);

  const auto local = graph.getLocalGraphHost();
  const auto row_ids = graph.getRowMap()->getLocalMap(), column_ids = graph.getColMap()->getLocalMap();
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local.numRows()); ++row) {
    const std::size_t begin = local.row_map(row), end = local.row_map(row + 1);
    if (fixed_row(row, 0) == 0.0) {
      for (std::size_t k = begin; k < end; ++k)
        if (fixed_column(local.entries(k), 0) != 0.0) entries_.push_back({k, row, local.entries(k)});
      continue;
    }
    const LocalOrdinal own = column_ids.getLocalElement(row_ids.getGlobalElement(row));
    std::size_t diagonal = end;
    for (std::size_t k = begin; k < end; ++k)
      if (local.entries(k) == own) diagonal = k;
    if (diagonal == end) throw std::logic_error("a prescribed row has no diagonal in the system's graph");
    row_begin_.push_back(begin);
    row_end_.push_back(end);
    diagonal_.push_back(diagonal);
  }
  entries_.shrink_to_fit();
}

void DirichletElimination::impose(Matrix& matrix, const Vector& increment, double diagonal, Vector& rhs) const {
  const RCP<const Vector> columns = on_columns(*matrix.getCrsGraph(), rcp(&increment, false));
  const auto values = matrix.getLocalMatrixHost().values;
  const auto step = columns->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto right = rhs.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const Entry& entry : entries_) {
    right(entry.row, 0) -= values(entry.offset) * step(entry.column, 0);
    values(entry.offset) = 0.0;
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t k = row_begin_[i]; k < row_end_[i]; ++k) values(k) = 0.0;
    values(diagonal_[i]) = diagonal;
    right(rows_[i], 0) = 0.0;
  }
}

}  // namespace mortise::detail
