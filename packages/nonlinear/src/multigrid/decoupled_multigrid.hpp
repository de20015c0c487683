#pragma once
// Multigrid for a condensed contact system: on what is left of it once the gaps are unknowns of their own.

#include "mortise/contact/decoupling.hpp"
#include "mortise/core/types.hpp"

namespace mortise::detail {

/// The rows C_m = L'_mm A_m S' + (N A_D N)_m of the matrix C below, m with all that DecoupledSystem::contact_dofs() marks, from which
/// alone L' hands on anything. As an operator: the product has several times the entries of its factors.
class RowsOfDecoupled : public Operator {
 public:
  /// @param A         A_m
  /// @param test      L'_mm, transposed
  /// @param trial     S' - I
  /// @param relative  (N A_D N)_m
  /// @param block     C_mm
  RowsOfDecoupled(RCP<const Matrix> A, RCP<const Matrix> test, RCP<const Matrix> trial, RCP<const Matrix> relative, RCP<const Matrix> block)
      : A_(std::move(A)), test_(std::move(test)), trial_(std::move(trial)), relative_(std::move(relative)), block_(std::move(block)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return trial_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return block_->getRangeMap(); }
  /// C_mm
  const RCP<const Matrix>& block() const { return block_; }
  /// y = C_m x
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;

 private:
  RCP<const Matrix> A_, test_, trial_, relative_, block_;
};

/// Let A be the condensed matrix, and S, L the change of unknowns and of equations of a Decoupling. Then L A S is the matrix of the bodies joined by
/// stick or by slip without friction. Next to it, in the eliminated directions N, stands the relative motion w of the surfaces. Each component of w
/// has an equation of its own:
///   C = L' A S' + N A_D N,   S' = S (I - N),   L' = (I - N) L,   A_D the nodes' diagonal blocks of A.
/// C has the near null space of the bodies, no matter how stiff they are relative to one another. With w = (N A_D N)^-1 N b,
///   A^-1 b ~ w + S' C^-1 L' (b - A w).
class DecoupledSystem {
 public:
  /// Collective.
  DecoupledSystem(RCP<const Matrix> A, const Decoupling& decoupling);

  /// C. Collective.
  RCP<Matrix> matrix() const;
  /// C_m, each row on the rank that owns it, for some m that holds contact_dofs(). Collective.
  RowsOfDecoupled rows(const RCP<const Map>& m) const;
  /// y += S' x, y = L' x.
  void add_trial(const MultiVector& x, MultiVector& y) const;
  void test(const MultiVector& x, MultiVector& y) const;
  /// w: the relative motion that the equations of the eliminated directions ask for by themselves.
  void relative_motion(const MultiVector& b, MultiVector& w) const;
  /// b -= A w
  void subtract_relative_motion(const MultiVector& w, MultiVector& b) const;
  /// 1 at the dofs of closed slave nodes and of the nodes of masters to which they are tied.
  const RCP<const Vector>& contact_dofs() const { return contact_dofs_; }
  /// 1 at those of masters alone, which are no closed slave nodes'.
  Vector master_dofs() const;
  /// The rows of a node.
  int dimension() const { return decoupling_.dimension; }
  /// modes -= N modes
  void take_out_eliminated(MultiVector& modes) const;

 private:
  RCP<const Matrix> A_;
  Decoupling decoupling_;
  RCP<Matrix> inner_, inverse_;  ///< N A_D N; (N A_D N + I - N)^-1 N
  RCP<const Matrix> relative_;   ///< the columns of A in which w may differ from 0; the others are empty
  RCP<const Vector> contact_dofs_;
};

/// The inverse of a DecoupledSystem with a preconditioner P of C in the place of the inverse of C.
class DecoupledPreconditioner : public Operator {
 public:
  DecoupledPreconditioner(std::shared_ptr<const DecoupledSystem> system, RCP<const Operator> preconditioner)
      : system_(std::move(system)), preconditioner_(std::move(preconditioner)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return preconditioner_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return preconditioner_->getRangeMap(); }
  /// y = w + S' P L' (x - A w)
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;

 private:
  std::shared_ptr<const DecoupledSystem> system_;
  RCP<const Operator> preconditioner_;
};

}  // namespace mortise::detail
