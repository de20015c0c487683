#pragma once
// The nodes in contact, solved for directly: where a solve starts, and what a multigrid cycle leaves there.

#include <Tpetra_Import.hpp>
#include <memory>

#include "mortise/core/types.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// The exact solution in some dofs m, those elsewhere held: y_m = C_mm^-1 x_m, 0 elsewhere.
class InterfaceSolution : public Operator {
 public:
  /// @param block  C_mm
  /// @param dofs   of all of C
  /// Collective.
  InterfaceSolution(const RCP<const Matrix>& block, const RCP<const Map>& dofs);
  Teuchos::RCP<const Map> getDomainMap() const override { return to_m_.getSourceMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return to_m_.getSourceMap(); }
  /// Throws StepFailure(linear_solver), on every rank, if C_mm is singular.
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;
  /// y_m += C_mm^-1 x_m. Throws as apply().
  void add(const Vector& x_m, Vector& y) const;
  /// From all of C to m.
  const Import& to_m() const { return to_m_; }

 private:
  Import to_m_;
  std::unique_ptr<LinearSolver> inverse_;  ///< of C_mm
};

/// A preconditioner V of C and, after it, the exact solution in some dofs m:
///   y = V x,   y_m += C_mm^-1 (x - C y)_m.
/// Made for the nodes in contact and their neighbours. A slave that is stiffer by orders of magnitude makes the diagonal at the nodes of the master
/// large. The energy of a motion that it does not feel, M^ d_m = 0, stays small. Such motions are as short as facets are: no coarse level has them,
/// and smoothers, which divide by the diagonal or by sums of rows, hardly change them. Also, V may be that of an earlier C, which differs where nodes
/// have opened, closed or begun to slip.
class InterfaceCorrection : public Operator {
 public:
  /// @param rows  C_m, one row at least, each on the rank that owns it in C
  InterfaceCorrection(RCP<const Operator> rows, RCP<const InterfaceSolution> solution, RCP<const Operator> preconditioner)
      : preconditioner_(std::move(preconditioner)), rows_(std::move(rows)), solution_(std::move(solution)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return preconditioner_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return preconditioner_->getRangeMap(); }
  /// Throws as InterfaceSolution::apply().
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;

 private:
  RCP<const Operator> preconditioner_;
  RCP<const Operator> rows_;  ///< C_m
  RCP<const InterfaceSolution> solution_;
};

}  // namespace mortise::detail
