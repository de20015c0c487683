#include "condensed_matrix.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>

#include "mortise/core/trilinos_versions.hpp"

namespace mortise::detail {

bool CondensedMatrix::open(const ContactSystem& contact, const ContactEvaluation& at, const Matrix& bulk) {
  const RCP<const Graph> bulk_graph = bulk.getCrsGraph();
  if (!bulk_graph_.is_null() && bulk_graph_ != bulk_graph) ++version_;
  const RCP<const Graph> graph = contact.graph(
      at, [&] { return bulk_graph; }, version_);
  const bool is_new = matrix_.is_null() || matrix_->getCrsGraph() != graph;
  if (is_new || bulk_graph_ != bulk_graph) {
    columns_.clear();
    for (const GlobalOrdinal id : local_ids(*bulk_graph->getColMap())) columns_.push_back(graph->getColMap()->getLocalElement(id));
  }
  bulk_graph_ = bulk_graph;
  if (is_new)
    matrix_ = rcp(new Matrix(graph));
  else if (!matrix_->isFillActive())
    matrix_->resumeFill();
  matrix_->setAllToScalar(0.0);
  return is_new;
}

void CondensedMatrix::add(const Matrix& bulk, double weight) {
  std::vector<LocalOrdinal> to;
  std::vector<double> scaled;
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_row_count(bulk)); ++row) {
    Matrix::local_inds_host_view_type columns;
    Matrix::values_host_view_type values;
    bulk.getLocalRowView(row, columns, values);
    to.resize(columns.extent(0));
    scaled.resize(columns.extent(0));
    for (std::size_t k = 0; k < to.size(); ++k) {
      to[k] = columns_[columns(k)];
      scaled[k] = weight * values(k);
    }
    matrix_->sumIntoLocalValues(row, static_cast<LocalOrdinal>(to.size()), scaled.data(), to.data());
  }
}

void CondensedMatrix::replace_rows(const std::vector<LocalOrdinal>& rows, const Matrix& bulk, double weight, double diagonal) {
  for (const LocalOrdinal row : rows) {
    Matrix::local_inds_host_view_type columns, own_columns;
    Matrix::values_host_view_type values, own_values;
    matrix_->getLocalRowView(row, own_columns, own_values);
    const std::vector<double> zeros(own_columns.extent(0), 0.0);
    matrix_->replaceLocalValues(row, static_cast<LocalOrdinal>(zeros.size()), zeros.data(), own_columns.data());
    if (diagonal != 0.0) {
      const LocalOrdinal column = matrix_->getColMap()->getLocalElement(matrix_->getRowMap()->getGlobalElement(row));
      matrix_->replaceLocalValues(row, 1, &diagonal, &column);
      continue;
    }
    bulk.getLocalRowView(row, columns, values);
    for (std::size_t k = 0; k < columns.extent(0); ++k) {
      const double value = weight * values(k);
      matrix_->replaceLocalValues(row, 1, &value, &columns_[columns(k)]);
    }
  }
}

}  // namespace mortise::detail
