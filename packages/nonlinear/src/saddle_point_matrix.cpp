#include "saddle_point_matrix.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

namespace mortise::detail {
namespace {

// A local row's entries in the numbering of both maps, times `factor`.
void append_row(const Matrix& block, LocalOrdinal row, const std::vector<GlobalOrdinal>& ids, double factor, std::vector<GlobalOrdinal>& columns,
                std::vector<double>& values) {
  Matrix::local_inds_host_view_type column_view;
  Matrix::values_host_view_type value_view;
  block.getLocalRowView(row, column_view, value_view);
  for (std::size_t k = 0; k < column_view.extent(0); ++k) {
    columns.push_back(ids[column_view(k)]);
    values.push_back(factor * value_view(k));
  }
}

}  // namespace

SaddlePointMatrix::SaddlePointMatrix(RCP<const Map> first, RCP<const Map> second) : first_(std::move(first)), second_(std::move(second)) {
  const std::size_t count = first_->getNodeNumElements();
  both_ = rcp(new const Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), count + second_->getNodeNumElements(), 0, first_->getComm()));
  const auto numbered = [&](const RCP<const Map>& map, std::size_t begin) {
    const auto ids = rcp(new Vector(map));
    const auto view = ids->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t row = 0; row < view.extent(0); ++row)
      view(row, 0) = static_cast<double>(both_->getGlobalElement(static_cast<LocalOrdinal>(begin + row)));
    return ids;
  };
  first_ids_ = numbered(first_, 0);
  second_ids_ = numbered(second_, count);
}

std::vector<GlobalOrdinal> SaddlePointMatrix::column_ids(const Matrix& block, const Vector& ids) const {
  Vector on_columns(block.getColMap());
  on_columns.doImport(ids, Import(ids.getMap(), block.getColMap()), Tpetra::INSERT);
  const auto view = on_columns.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<GlobalOrdinal> result(view.extent(0));
  for (std::size_t c = 0; c < result.size(); ++c) result[c] = static_cast<GlobalOrdinal>(view(c, 0));
  return result;
}

RCP<Matrix> SaddlePointMatrix::merged(const Matrix& A, const Matrix& B, const Matrix& C, const Matrix& D, const Vector& S) const {
  const auto A_ids = column_ids(A, *first_ids_), B_ids = column_ids(B, *second_ids_);
  const auto C_ids = column_ids(C, *first_ids_), D_ids = column_ids(D, *second_ids_);
  const auto count = static_cast<LocalOrdinal>(first_->getNodeNumElements());
  const auto rows = static_cast<LocalOrdinal>(both_->getNodeNumElements());
  std::vector<std::size_t> sizes(rows);
  for (LocalOrdinal row = 0; row < rows; ++row)
    sizes[row] = row < count ? A.getNumEntriesInLocalRow(row) + B.getNumEntriesInLocalRow(row)
                             : C.getNumEntriesInLocalRow(row - count) + D.getNumEntriesInLocalRow(row - count);
  const auto result = rcp(new Matrix(both_, Teuchos::arrayViewFromVector(sizes)));
  const auto scale = S.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<GlobalOrdinal> columns;
  std::vector<double> values;
  for (LocalOrdinal row = 0; row < rows; ++row) {
    columns.clear();
    values.clear();
    if (row < count) {
      append_row(A, row, A_ids, 1.0, columns, values);
      append_row(B, row, B_ids, 1.0, columns, values);
    } else {
      append_row(C, row - count, C_ids, scale(row - count, 0), columns, values);
      append_row(D, row - count, D_ids, scale(row - count, 0), columns, values);
    }
    result->insertGlobalValues(both_->getGlobalElement(row), static_cast<LocalOrdinal>(columns.size()), values.data(), columns.data());
  }
  result->fillComplete(both_, both_);
  return result;
}

RCP<Vector> SaddlePointMatrix::merged(const Vector& first, const Vector& second) const {
  const auto both = rcp(new Vector(both_));
  Tpetra::deep_copy(*both->offsetViewNonConst(first_, 0), first);
  Tpetra::deep_copy(*both->offsetViewNonConst(second_, first_->getNodeNumElements()), second);
  return both;
}

void SaddlePointMatrix::split(const Vector& both, Vector& first, Vector& second) const {
  Tpetra::deep_copy(first, *both.offsetView(first_, 0));
  Tpetra::deep_copy(second, *both.offsetView(second_, first_->getNodeNumElements()));
}

}  // namespace mortise::detail
