#include "multigrid/interface_correction.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include "linear/direct_solver.hpp"

namespace mortise::detail {

InterfaceSolution::InterfaceSolution(const RCP<const Matrix>& block, const RCP<const Map>& dofs)
    : to_m_(dofs, block->getRowMap()), inverse_(make_mumps_solver({}, {}, "direct solver of the nodes in contact")) {
  inverse_->set_matrix(block, true, {});
}

void InterfaceSolution::add(const Vector& x_m, Vector& y) const {
  Vector change(to_m_.getTargetMap()), changed(to_m_.getTargetMap());
  inverse_->solve(x_m, change);
  changed.doImport(y, to_m_, Tpetra::INSERT);
  changed.update(1.0, change, 1.0);
  y.doExport(changed, to_m_, Tpetra::INSERT);  // ADD would replace what stays on its rank
}

void InterfaceSolution::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  Vector x_m(to_m_.getTargetMap());
  y.putScalar(0.0);
  for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
    x_m.doImport(*x.getVector(v), to_m_, Tpetra::INSERT);
    add(x_m, *y.getVectorNonConst(v));
  }
}

void InterfaceCorrection::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const {
  preconditioner_->apply(x, y);
  Vector product(rows_->getRangeMap()), residual(rows_->getRangeMap());
  for (std::size_t v = 0; v < x.getNumVectors(); ++v) {
    residual.doImport(*x.getVector(v), solution_->to_m(), Tpetra::INSERT);
    rows_->apply(*y.getVector(v), product);
    residual.update(-1.0, product, 1.0);
    solution_->add(residual, *y.getVectorNonConst(v));
  }
}

}  // namespace mortise::detail
