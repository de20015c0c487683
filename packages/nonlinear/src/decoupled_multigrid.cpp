#include "decoupled_multigrid.hpp"

#include <Eigen/Dense>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

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

DecoupledSystem::DecoupledSystem(const Matrix& A, const Decoupling& decoupling, int dimension) : decoupling_(decoupling) {
  const RCP<const Map> dofs = A.getRowMap();
  const auto inner = rcp(new Matrix(dofs, static_cast<std::size_t>(dimension)));  // N A_D N
  inverse_ = rcp(new Matrix(dofs, static_cast<std::size_t>(dimension)));
  const auto eliminated = decoupling.eliminated->getLocalMatrixHost();
  for (LocalOrdinal first = 0; first < eliminated.numRows(); first += dimension) {
    bool is_slave = false;
    for (LocalOrdinal i = 0; i < dimension; ++i) is_slave = is_slave || eliminated.rowConst(first + i).length > 0;
    if (!is_slave) continue;
    const Block N = diagonal_block(*decoupling.eliminated, first, dimension);
    const Block block = N * diagonal_block(A, first, dimension) * N, rest = Block::Identity(dimension, dimension) - N;
    const Block inverse = (block + rest).inverse() * N;
    for (int i = 0; i < dimension; ++i)
      for (int k = 0; k < dimension; ++k) {
        const GlobalOrdinal column = dofs->getGlobalElement(first + k);
        inner->insertGlobalValues(dofs->getGlobalElement(first + i), 1, &block(i, k), &column);
        inverse_->insertGlobalValues(dofs->getGlobalElement(first + i), 1, &inverse(i, k), &column);
      }
  }
  inner->fillComplete(dofs, dofs);
  inverse_->fillComplete(dofs, dofs);

  Matrix both(dofs, 0);
  {
    Matrix right(dofs, 0);
    Tpetra::MatrixMatrix::Multiply(A, false, *decoupling.trial, false, right);
    Tpetra::MatrixMatrix::Multiply(*decoupling.test, true, right, false, both);
  }
  matrix_ = Tpetra::MatrixMatrix::add(1.0, false, both, 1.0, false, *inner);
}

RCP<const Matrix> DecoupledSystem::columns_of_relative_motion(const Matrix& A) const {
  Vector marks(A.getDomainMap()), column_marks(A.getColMap());
  {
    const auto mark = marks.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto inverse = inverse_->getLocalMatrixHost();
    for (LocalOrdinal row = 0; row < inverse.numRows(); ++row) mark(row, 0) = inverse.rowConst(row).length > 0 ? 1.0 : 0.0;
  }
  column_marks.doImport(marks, Import(A.getDomainMap(), A.getColMap()), Tpetra::INSERT);
  const auto is_marked = column_marks.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto local = A.getLocalMatrixHost();
  const auto kept = [&](LocalOrdinal row, const auto& use) {
    const auto entries = local.rowConst(row);
    for (LocalOrdinal k = 0; k < entries.length; ++k)
      if (is_marked(entries.colidx(k), 0) != 0.0) use(entries.colidx(k), entries.value(k));
  };
  std::vector<std::size_t> sizes(static_cast<std::size_t>(local.numRows()), 0);
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) kept(row, [&](LocalOrdinal, double) { ++sizes[row]; });
  const auto result = rcp(new Matrix(A.getRowMap(), A.getColMap(), Teuchos::arrayViewFromVector(sizes)));
  for (LocalOrdinal row = 0; row < local.numRows(); ++row)
    kept(row, [&](LocalOrdinal column, double value) { result->insertLocalValues(row, 1, &value, &column); });
  result->fillComplete(A.getDomainMap(), A.getRangeMap());
  return result;
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
