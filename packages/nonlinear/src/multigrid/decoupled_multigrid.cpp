#include "multigrid/decoupled_multigrid.hpp"

#include <Eigen/Dense>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "multigrid/sparse_parts.hpp"

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

/// 1 at the dofs of closed slave nodes, which have entries in `inverse`, and of the nodes of masters to which `trial` ties them. Collective.
RCP<const Vector> find_contact_dofs(const Matrix& trial, const Matrix& inverse, int dimension) {
  Vector column_marks(trial.getColMap());
  const auto marks = rcp(new Vector(trial.getRowMap()));
  {
    const auto mark = column_marks.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto local = trial.getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < local.numRows(); ++row)
      for (LocalOrdinal k = 0; k < local.rowConst(row).length; ++k) mark(local.rowConst(row).colidx(k), 0) = 1.0;
  }
  marks->doExport(column_marks, Export(trial.getColMap(), trial.getRowMap()), Tpetra::ADD);
  const auto mark = marks->getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal first = 0; first < static_cast<LocalOrdinal>(marks->getLocalLength()); first += dimension) {
    bool in_contact = inverse.getNumEntriesInLocalRow(first) > 0;
    for (int i = 0; i < dimension; ++i) in_contact = in_contact || mark(first + i, 0) != 0.0;
    for (int i = 0; i < dimension; ++i) mark(first + i, 0) = in_contact ? 1.0 : 0.0;
  }
  return marks;
}

}  // namespace

DecoupledSystem::DecoupledSystem(RCP<const Matrix> A, const Decoupling& decoupling) : A_(std::move(A)), decoupling_(decoupling) {
  const RCP<const Map> dofs = A_->getRowMap();
  const int dimension = decoupling.dimension;
  const auto eliminated = decoupling.eliminated->getLocalMatrixHost();
  std::vector<std::size_t> sizes(static_cast<std::size_t>(eliminated.numRows()), 0);
  for (LocalOrdinal row = 0; row < eliminated.numRows(); ++row)
    if (eliminated.rowConst(row).length > 0) std::fill_n(sizes.begin() + row / dimension * dimension, dimension, dimension);
  inner_ = rcp(new Matrix(dofs, Teuchos::arrayViewFromVector(sizes)));
  inverse_ = rcp(new Matrix(dofs, Teuchos::arrayViewFromVector(sizes)));
  for (LocalOrdinal first = 0; first < eliminated.numRows(); first += dimension) {
    if (sizes[first] == 0) continue;
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

  Vector marks(A_->getDomainMap());
  {
    const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto inverse = inverse_->getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < inverse.numRows(); ++row) mark(row, 0) = inverse.rowConst(row).length > 0 ? 1.0 : 0.0;
  }
  relative_ = marked_columns(*A_, marks);
  contact_dofs_ = find_contact_dofs(*decoupling.trial, *inverse_, dimension);
}

// L' A S' = A + A (S' - I) + (L' - I) A + (L' - I) A (S' - I): what is added has entries near the contact alone.
RCP<Matrix> DecoupledSystem::matrix() const {
  const RCP<const Map> dofs = A_->getRowMap();
  Matrix by_trial(dofs, 0), by_test(dofs, 0), by_both(dofs, 0);
  Tpetra::MatrixMatrix::Multiply(*relative_, false, *decoupling_.trial, false, by_trial);
  Tpetra::MatrixMatrix::Multiply(*decoupling_.test, true, *A_, false, by_test);
  Tpetra::MatrixMatrix::Multiply(*decoupling_.test, true, by_trial, false, by_both);
  return sum_without_zeros(*A_, *sum(*sum(by_trial, by_test), *sum(by_both, *inner_)));
}

RowsOfDecoupled DecoupledSystem::rows(const RCP<const Map>& m) const {
  const RCP<const Matrix> A = detail::rows(*A_, m);
  const RCP<const Matrix> test = detail::rows(*columns_of_identity_plus(*decoupling_.test, m), m);
  Matrix by_trial(m, 0), product(m, 0);
  Tpetra::MatrixMatrix::Multiply(*A, false, *columns_of_identity_plus(*decoupling_.trial, m), false, by_trial);
  Tpetra::MatrixMatrix::Multiply(*test, true, by_trial, false, product);
  return {A, test, decoupling_.trial, detail::rows(*inner_, m), sum(product, *block(*inner_, m))};
}

void RowsOfDecoupled::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  MultiVector moved(x, Teuchos::Copy), of_A(A_->getRangeMap(), x.getNumVectors());
  trial_->apply(x, moved, Teuchos::NO_TRANS, 1.0, 1.0);
  A_->apply(moved, of_A);
  test_->apply(of_A, y, Teuchos::TRANS);
  relative_->apply(x, y, Teuchos::NO_TRANS, 1.0, 1.0);
}

Vector DecoupledSystem::master_dofs() const {
  Vector marks(*contact_dofs_, Teuchos::Copy);
  const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(marks.getLocalLength()); ++row)
    if (inverse_->getNumEntriesInLocalRow(row) > 0) mark(row, 0) = 0.0;
  return marks;
}

void DecoupledSystem::add_trial(const MultiVector& x, MultiVector& y) const {
  y.update(1.0, x, 1.0);
  decoupling_.trial->apply(x, y, Teuchos::NO_TRANS, 1.0, 1.0);
}

void DecoupledSystem::test(const MultiVector& x, MultiVector& y) const {
  Tpetra::deep_copy(y, x);
  decoupling_.test->apply(x, y, Teuchos::TRANS, 1.0, 1.0);
}

void DecoupledSystem::relative_motion(const MultiVector& b, MultiVector& w) const { inverse_->apply(b, w); }

void DecoupledSystem::subtract_relative_motion(const MultiVector& w, MultiVector& b) const { relative_->apply(w, b, Teuchos::NO_TRANS, -1.0, 1.0); }

void DecoupledSystem::take_out_eliminated(MultiVector& modes) const {
  const MultiVector all(modes, Teuchos::Copy);
  decoupling_.eliminated->apply(all, modes, Teuchos::NO_TRANS, -1.0, 1.0);
}

void DecoupledPreconditioner::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  MultiVector rest(x, Teuchos::Copy), tested(x.getMap(), x.getNumVectors()), solved(x.getMap(), x.getNumVectors());
  system_->relative_motion(x, y);
  system_->subtract_relative_motion(y, rest);
  system_->test(rest, tested);
  preconditioner_->apply(tested, solved);
  system_->add_trial(solved, y);
}

}  // namespace mortise::detail
