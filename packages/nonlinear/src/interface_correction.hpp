#pragma once
// What a multigrid cycle leaves of a contact system at the nodes in contact, taken away by a direct solve there.

#include <memory>

#include "mortise/core/types.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// A preconditioner V of C and, after it, the exact solution in some dofs m:
///   y = V x,   y_m += C_mm^-1 (x - C y)_m.
/// Made for the nodes in contact and their neighbours. A slave that is stiffer by orders of magnitude makes the diagonal at the nodes of the master
/// large, but not what a motion costs that it does not feel, M^ d_m = 0. Such motions are as short as facets are: no coarse level has them, and
/// Gauss-Seidel, which divides by the diagonal, hardly changes them. Also, V may be that of an earlier C, which differs where nodes have opened,
/// closed or begun to slip.
class InterfaceCorrection : public Operator {
 public:
  /// @param rows   C_m, one row at least, each on the rank that owns it in C
  /// @param block  C_mm
  /// Collective.
  InterfaceCorrection(RCP<const Operator> rows, const RCP<const Matrix>& block, RCP<const Operator> preconditioner);
  Teuchos::RCP<const Map> getDomainMap() const override { return preconditioner_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return preconditioner_->getRangeMap(); }
  /// Throws StepFailure(linear_solver), on every rank, if C_mm is singular.
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;

 private:
  RCP<const Operator> preconditioner_;
  Import to_dofs_;                         ///< of all of C to m
  RCP<const Operator> rows_;               ///< C_m
  std::unique_ptr<LinearSolver> inverse_;  ///< of C_mm
};

}  // namespace mortise::detail
