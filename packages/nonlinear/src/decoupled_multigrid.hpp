#pragma once
// Multigrid for a condensed contact system: on what is left of it once the gaps are unknowns of their own.

#include "mortise/contact/decoupling.hpp"
#include "mortise/core/types.hpp"

namespace mortise::detail {

/// With the condensed matrix A and the change of unknowns and of equations S, L of a Decoupling, L A S is that of the bodies joined by stick or by
/// slip without friction, and next to it, in the eliminated directions N, the relative motion w of the surfaces, each with an equation of its own:
///   C = L' A S' + N A_D N,   S' = S (I - N),   L' = (I - N) L,   A_D the nodes' diagonal blocks of A.
/// It has the near null space of the bodies, no matter how stiff they are next to one another. A^-1 ~ S C^-1 L.
class DecoupledSystem {
 public:
  /// @param dimension  dofs of a node, which stand together in every map
  DecoupledSystem(const Matrix& A, const Decoupling& decoupling, int dimension);

  const RCP<Matrix>& matrix() const { return matrix_; }
  /// y = S x, y = L x.
  void trial(const MultiVector& x, MultiVector& y) const;
  void test(const MultiVector& x, MultiVector& y) const;
  /// x = S w with the relative motion w that the equations of the eliminated directions ask for by themselves.
  void first_guess(const Vector& b, Vector& x) const;
  /// modes -= N modes
  void take_out_eliminated(MultiVector& modes) const;

 private:
  Decoupling decoupling_;
  RCP<Matrix> matrix_, inverse_;  ///< C; (N A_D N + I - N)^-1 N
};

/// S P L for a preconditioner P of C.
class DecoupledPreconditioner : public Operator {
 public:
  DecoupledPreconditioner(std::shared_ptr<const DecoupledSystem> system, RCP<const Operator> preconditioner)
      : system_(std::move(system)), preconditioner_(std::move(preconditioner)) {}
  Teuchos::RCP<const Map> getDomainMap() const override { return preconditioner_->getDomainMap(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return preconditioner_->getRangeMap(); }
  /// y = S P L x
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, Scalar, Scalar) const override;

 private:
  std::shared_ptr<const DecoupledSystem> system_;
  RCP<const Operator> preconditioner_;
};

}  // namespace mortise::detail
