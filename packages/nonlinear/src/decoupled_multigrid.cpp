#include "decoupled_multigrid.hpp"

#include <Eigen/Dense>
#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <map>

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

/// A - I for a matrix that is the identity but for the rows in which `marked` has entries; those alone are kept.
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

/// The columns of A, and after them those of B that are not among them. Collective.
RCP<const Map> joint_columns(const Matrix& A, const Matrix& B) {
  if (A.getComm()->getSize() == 1) return A.getColMap();
  const auto own = A.getColMap()->getNodeElementList();
  std::vector<GlobalOrdinal> ids(own.begin(), own.end());
  for (const GlobalOrdinal id : B.getColMap()->getNodeElementList())
    if (!A.getColMap()->isNodeGlobalElement(id)) ids.push_back(id);
  const auto invalid = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  return rcp(new const Map(invalid, ids.data(), static_cast<LocalOrdinal>(ids.size()), 0, A.getComm()));
}

/// A + B, B with few entries, without entries of A that are 0, as those of prescribed rows and columns are. Collective.
RCP<Matrix> sum_without_zeros(const Matrix& A, const Matrix& B) {
  const RCP<const Map> columns = joint_columns(A, B);
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

  // L' A S' = A + A (S' - I) + (L' - I) A + (L' - I) A (S' - I): what is added has entries near the contact alone.
  const RCP<Matrix> trial = beyond_identity(*decoupling.trial, *inverse_), test = beyond_identity(*decoupling.test, *inverse_);
  Matrix by_trial(dofs, 0), by_test(dofs, 0), by_both(dofs, 0);
  Tpetra::MatrixMatrix::Multiply(*columns_of_relative_motion(A), false, *trial, false, by_trial);
  Tpetra::MatrixMatrix::Multiply(*test, true, A, false, by_test);
  Tpetra::MatrixMatrix::Multiply(*test, true, by_trial, false, by_both);
  matrix_ = sum_without_zeros(A, *sum(*sum(by_trial, by_test), *sum(by_both, *inner)));
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
