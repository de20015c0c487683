#include "interface_correction.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include "direct_solver.hpp"

namespace mortise::detail {

InterfaceCorrection::InterfaceCorrection(RCP<const Operator> rows, const RCP<const Matrix>& block, RCP<const Operator> preconditioner)
    : preconditioner_(std::move(preconditioner)),
      to_dofs_(preconditioner_->getRangeMap(), rows->getRangeMap()),
      rows_(std::move(rows)),
      inverse_(make_mumps_solver({}, {}, "direct solver of the nodes in contact")) {
  inverse_->set_matrix(block, true, {});
}

void InterfaceCorrection::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  preconditioner_->apply(x, y);
  Vector of_rows(to_dofs_.getTargetMap()), residual(of_rows.getMap()), correction(of_rows.getMap()), corrected(of_rows.getMap());
  for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
    residual.doImport(*x.getVector(v), to_dofs_, Tpetra::INSERT);
    rows_->apply(*y.getVector(v), of_rows);
    residual.update(-1.0, of_rows, 1.0);
    inverse_->solve(residual, correction);
    corrected.doImport(*y.getVector(v), to_dofs_, Tpetra::INSERT);
    corrected.update(1.0, correction, 1.0);
    y.getVectorNonConst(v)->doExport(corrected, to_dofs_, Tpetra::INSERT);  // ADD would replace what stays on its rank
  }
}

}  // namespace mortise::detail
