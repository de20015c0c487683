#pragma once
// Equations of several fields in one norm.

#include "mortise/core/types.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// The equations W A x = W b of the solves with one right-hand side. GMRES minimises one norm of all residuals, |W (b - A x)|. Those of different
/// fields have different units, and Newton's method tests each field by itself. So the rows of field f are divided by the size of its right-hand
/// side,
///   W_f = 1 / max(|b_f|, c max_g(omega_g |b_g|) / omega_f),
/// omega the weights of the fields. With |W (b - A x)| <= t |W b| every field has |b_f - (A x)_f| <= t sqrt(fields) / W_f: none is left behind.
/// A field whose b_f is round-off of what it was, or 0, is compared with what another one may bring about in it. One field has W = I.
class WeightedEquations {
 public:
  /// c. Changes of temperature bring about expansions of 1e-3 to 1e-2 of the size of a model where they are as large as temperatures are; c has to be
  /// far below. It has to be above round-off over the smallest tolerance.
  static constexpr double least_share = 1e-4;

  /// Collective.
  /// @param fields  null: A has one
  WeightedEquations(RCP<const Matrix> A, const FieldsOfRows* fields, const Vector& b);

  /// W A, W b, |W b|.
  const RCP<const Operator>& A() const { return A_; }
  const Vector& b() const { return *b_; }
  double size() const { return size_; }
  /// P W^-1, of a preconditioner P of A.
  RCP<const Operator> preconditioner(const RCP<const Operator>& P) const;

 private:
  RCP<const Operator> A_;
  RCP<const Vector> b_;
  RCP<const Vector> inverse_weights_;  ///< the diagonal of W^-1; null: I
  double size_ = 0.0;
};

}  // namespace mortise::detail
