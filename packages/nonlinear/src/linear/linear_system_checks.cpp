#include "linear/linear_system_checks.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "mortise/core/error.hpp"

namespace mortise::detail {

double check_finite(const Matrix& matrix, const Vector& b, const std::string& solver) {
  const auto values = matrix.getLocalMatrixHost().values;
  int finite = 1, everywhere = 1;
  for (std::size_t k = 0; k < values.extent(0); ++k)
    if (!std::isfinite(values(k))) finite = 0;
  Teuchos::reduceAll(*matrix.getComm(), Teuchos::REDUCE_MIN, finite, Teuchos::outArg(everywhere));
  if (!everywhere) throw StepFailure(FailureKind::linear_solver, solver + ": the matrix holds entries that are not finite");
  const double norm = b.norm2();
  if (!std::isfinite(norm)) throw StepFailure(FailureKind::linear_solver, solver + ": the right-hand side is not finite");
  return norm;
}

double true_residual(const Operator& matrix, const Vector& b, const Vector& x, Vector& r) {
  Tpetra::deep_copy(r, b);
  matrix.apply(x, r, Teuchos::NO_TRANS, -1.0, 1.0);
  return r.norm2();
}

double largest_row_sum(const Matrix& matrix) {
  const auto local = matrix.getLocalMatrixHost();
  double mine = 0.0, all = 0.0;
  for (LocalOrdinal row = 0; row < local.numRows(); ++row) {
    double sum = 0.0;
    const auto entries = local.row(row);
    for (LocalOrdinal k = 0; k < entries.length; ++k) sum += std::abs(entries.value(k));
    mine = std::max(mine, sum);
  }
  Teuchos::reduceAll(*matrix.getComm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

double backward_error(double matrix_norm, const Vector& b, const Vector& x, const Vector& r) {
  return r.normInf() / (matrix_norm * x.normInf() + b.normInf());
}

}  // namespace mortise::detail
