#include "system/saddle_point_matrix.hpp"

#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "mortise/core/trilinos_versions.hpp"
#include "system/matrix_values.hpp"

namespace mortise::detail {

SaddlePointMatrix::SaddlePointMatrix(RCP<const Map> first, RCP<const Map> second) : first_(std::move(first)), second_(std::move(second)) {
  const std::size_t count = local_id_count(*first_);
  both_ = rcp(new const Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), count + local_id_count(*second_), 0, first_->getComm()));
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

void SaddlePointMatrix::build(const Blocks& blocks) {
  std::array<std::vector<GlobalOrdinal>, 4> ids;
  for (std::size_t b = 0; b < 4; ++b) {
    ids[b] = column_ids(*blocks[b], b % 2 == 0 ? *first_ids_ : *second_ids_);
    graphs_[b] = blocks[b]->getCrsGraph();
  }
  const auto count = static_cast<LocalOrdinal>(local_id_count(*first_));
  const auto rows = static_cast<LocalOrdinal>(local_id_count(*both_));
  std::vector<std::size_t> sizes(rows);
  std::vector<std::vector<GlobalOrdinal>> columns(rows);
  for (std::size_t b = 0; b < 4; ++b) {
    const auto entries = graphs_[b]->getLocalGraphHost();
    const LocalOrdinal begin = b < 2 ? 0 : count;
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(entries.numRows()); ++row)
      for (std::size_t k = entries.row_map(row); k < entries.row_map(row + 1); ++k) columns[begin + row].push_back(ids[b][entries.entries(k)]);
  }
  for (LocalOrdinal row = 0; row < rows; ++row) sizes[row] = columns[row].size();
  const auto graph = rcp(new Graph(both_, Teuchos::arrayViewFromVector(sizes)));
  for (LocalOrdinal row = 0; row < rows; ++row)
    graph->insertGlobalIndices(both_->getGlobalElement(row), static_cast<LocalOrdinal>(columns[row].size()), columns[row].data());
  graph->fillComplete(both_, both_);
  matrix_ = rcp(new Matrix(graph));
  matrix_->fillComplete(both_, both_);

  const auto target = graph->getLocalGraphHost();
  std::vector<std::size_t> place(local_id_count(*graph->getColMap()));
  for (std::size_t b = 0; b < 4; ++b) {
    const auto entries = graphs_[b]->getLocalGraphHost();
    const LocalOrdinal begin = b < 2 ? 0 : count;
    offsets_[b].resize(entries.entries.extent(0));
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(entries.numRows()); ++row) {
      for (std::size_t k = target.row_map(begin + row); k < target.row_map(begin + row + 1); ++k) place[target.entries(k)] = k;
      for (std::size_t k = entries.row_map(row); k < entries.row_map(row + 1); ++k)
        offsets_[b][k] = place[graph->getColMap()->getLocalElement(ids[b][entries.entries(k)])];
    }
  }
}

RCP<Matrix> SaddlePointMatrix::merged(const Matrix& A, const Matrix& B, const Matrix& C, const Matrix& D, const Vector& S) {
  const Blocks blocks = {&A, &B, &C, &D};
  bool same = !matrix_.is_null();
  for (std::size_t b = 0; same && b < 4; ++b) same = same_entries(*blocks[b]->getCrsGraph(), *graphs_[b]);
  if (!same) build(blocks);
  const auto values = matrix_->getLocalMatrixHost().values;
  const auto scale = S.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t b = 0; b < 4; ++b) {
    const auto block = blocks[b]->getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(block.numRows()); ++row) {
      const double factor = b < 2 ? 1.0 : scale(row, 0);
      for (std::size_t k = block.graph.row_map(row); k < block.graph.row_map(row + 1); ++k) values(offsets_[b][k]) = factor * block.values(k);
    }
  }
  return matrix_;
}

RCP<Vector> SaddlePointMatrix::merged(const Vector& first, const Vector& second) const {
  const auto both = rcp(new Vector(both_));
  Tpetra::deep_copy(*both->offsetViewNonConst(first_, 0), first);
  Tpetra::deep_copy(*both->offsetViewNonConst(second_, local_id_count(*first_)), second);
  return both;
}

void SaddlePointMatrix::split(const Vector& both, Vector& first, Vector& second) const {
  Tpetra::deep_copy(first, *both.offsetView(first_, 0));
  Tpetra::deep_copy(second, *both.offsetView(second_, local_id_count(*first_)));
}

}  // namespace mortise::detail
