#include "decoupled_multigrid.hpp"

#include <Eigen/Dense>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include "sparse_parts.hpp"

namespace mortise::detail {
namespace {

using Block = Eigen::MatrixXd;

/// The block of a node's dofs, which start at local row `first`, of a filled matrix.
Block diagonal_block(const Matrix& matrix, LocalOrdinal first, int dimension) {
  Block block = Block::Zero(dimension, dimension);
  const auto local = matrix.getLocalMatrixHost();
  const auto columns = matrix.getColMap()->getLocalMap();
  const GlobalOrdinal id = matrix.getRowMap()->getGlobalElement(first);
  for (int i = 0; i < dimension; ++i) {
    const auto row = local.rowConst(first + i);
    for (LocalOrdinal k = 0; k < row.length; ++k) {
      const GlobalOrdinal component = columns.getGlobalElement(row.colidx(k)) - id;
      if (component >= 0 && component < dimension) block(i, component) += row.value(k);
    }
  }
  return block;
}

}  // namespace

DecoupledSystem::DecoupledSystem(RCP<const Matrix> A, const Decoupling& decoupling, int dimension)
    : A_(std::move(A)), decoupling_(decoupling), dimension_(dimension) {
  const RCP<const Map> dofs = A_->getRowMap();
  inner_ = rcp(new Matrix(dofs, static_cast<std::size_t>(dimension)));
  inverse_ = rcp(new Matrix(dofs, static_cast<std::size_t>(dimension)));
  const auto eliminated = decoupling.eliminated->getLocalMatrixHost();
  for (LocalOrdinal first = 0; first < eliminated.numRows(); first += dimension) {
    bool is_slave = false;
    for (LocalOrdinal i = 0; i < dimension; ++i) is_slave = is_slave || eliminated.rowConst(first + i).length > 0;
    if (!is_slave) continue;
    const Block N = diagonal_block(*decoupling.eliminated, first, dimension);
    const Block block = N * diagonal_block(*A_, first, dimension) * N, rest = Block::Identity(dimension, dimension) - N;
    const Block inverse = (block + rest).inverse() * N;
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) {
        const GlobalOrdinal column = dofs->getGlobalElement(first + k);
        inner_->insertGlobalValues(dofs->getGlobalElement(first + i), 1, &block(i, k), &column);
        inverse_->insertGlobalValues(dofs->getGlobalElement(first + i), 1, &inverse(i, k), &column);
      }
  }
  inner_->fillComplete(dofs, dofs);
  inverse_->fillComplete(dofs, dofs);
}

// L' A S' = A + A (S' - I) + (L' - I) A + (L' - I) A (S' - I): what is added has entries near the contact alone.
RCP<Matrix> DecoupledSystem::matrix() const {
  const RCP<const Map> dofs = A_->getRowMap();
  const RCP<Matrix> trial = beyond_identity(*decoupling_.trial, *inverse_), test = beyond_identity(*decoupling_.test, *inverse_);
  Matrix by_trial(dofs, 0), by_test(dofs, 0), by_both(dofs, 0);
  Tpetra::MatrixMatrix::Multiply(*columns_of_relative_motion(), false, *trial, false, by_trial);
  Tpetra::MatrixMatrix::Multiply(*test, true, *A_, false, by_test);
  Tpetra::MatrixMatrix::Multiply(*test, true, by_trial, false, by_both);
  return sum_without_zeros(*A_, *sum(*sum(by_trial, by_test), *sum(by_both, *inner_)));
}

RCP<const Matrix> DecoupledSystem::rows(const RCP<const Map>& dofs) const {
  Matrix by_test(dofs, 0), product(dofs, 0);
  Tpetra::MatrixMatrix::Multiply(*columns(*decoupling_.test, dofs), true, *A_, false, by_test);
  Tpetra::MatrixMatrix::Multiply(by_test, false, *decoupling_.trial, false, product);
  return sum(product, *detail::rows(inner_, dofs));
}

RCP<const Matrix> DecoupledSystem::columns_of_relative_motion() const {
  const Matrix& A = *A_;
  Vector marks(A.getDomainMap()), column_marks(A.getColMap());
  {
    const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto inverse = inverse_->getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < inverse.numRows(); ++row) mark(row, 0) = inverse.rowConst(row).length > 0 ? 1.0 : 0.0;
  }
  column_marks.doImport(marks, Import(A.getDomainMap(), A.getColMap()), Tpetra::INSERT);
  const auto is_marked = column_marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto local = A.getLocalMatrixHost();
  const auto rows = static_cast<std::size_t>(local.numRows());
  Teuchos::ArrayRCP<std::size_t> starts(rows + 1, 0);
  std::vector<LocalOrdinal> columns;
  std::vector<double> values;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      if (const LocalOrdinal column = local.graph.entries(k); is_marked(column, 0) != 0.0) {
        columns.push_back(column);
        values.push_back(local.values(k));
      }
    starts[row + 1] = columns.size();
  }
  const auto result = rcp(new Matrix(A.getRowMap(), A.getColMap(), starts, Teuchos::arcpClone<LocalOrdinal>(Teuchos::arrayViewFromVector(columns)),
                                     Teuchos::arcpClone<double>(Teuchos::arrayViewFromVector(values))));
  result->expertStaticFillComplete(A.getDomainMap(), A.getRangeMap());
  return result;
}

RCP<const Map> DecoupledSystem::joined() const {
  const Matrix& trial = *decoupling_.trial;
  const RCP<const Map> dofs = trial.getRowMap();
  Vector column_marks(trial.getColMap()), marks(dofs);
  {
    const auto mark = column_marks.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto local = trial.getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
      const auto entries = local.rowConst(row);
      const bool is_slave = inverse_->getNumEntriesInLocalRow(row) > 0;
      for (LocalOrdinal k = 0; k < entries.length && is_slave; ++k) mark(entries.colidx(k), 0) = 1.0;
    }
  }
  marks.doExport(column_marks, Export(trial.getColMap(), dofs), Tpetra::ADD);
  const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  std::vector<GlobalOrdinal> ids;
  for (LocalOrdinal first = 0; first < static_cast<LocalOrdinal>(dofs->getNodeNumElements()); first += dimension_) {
    bool is_joined = false;
    for (int i = 0; i < dimension_; ++i) is_joined = is_joined || mark(first + i, 0) != 0.0;
    for (int i = 0; i < dimension_ && is_joined; ++i) ids.push_back(dofs->getGlobalElement(first + i));
  }
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new const Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, dofs->getComm()));
}

void DecoupledSystem::add_trial(const MultiVector& x, MultiVector& y) const { decoupling_.trial->apply(x, y, Teuchos::NO_TRANS, 1.0, 1.0); }

void DecoupledSystem::test(const MultiVector& x, MultiVector& y) const { decoupling_.test->apply(x, y, Teuchos::TRANS); }

void DecoupledSystem::relative_motion(const MultiVector& b, MultiVector& w) const { inverse_->apply(b, w); }

void DecoupledSystem::take_out_eliminated(MultiVector& modes) const {
  const MultiVector all(modes, Teuchos::Copy);
  decoupling_.eliminated->apply(all, modes, Teuchos::NO_TRANS, -1.0, 1.0);
}

void DecoupledPreconditioner::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  MultiVector rest(x, Teuchos::Copy), tested(x.getMap(), x.getNumVectors()), solved(x.getMap(), x.getNumVectors());
  system_->relative_motion(x, y);
  relative_->apply(y, rest, Teuchos::NO_TRANS, -1.0, 1.0);
  system_->test(rest, tested);
  preconditioner_->apply(tested, solved);
  system_->add_trial(solved, y);
}

}  // namespace mortise::detail
