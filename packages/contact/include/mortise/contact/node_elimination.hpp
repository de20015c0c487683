#pragma once
// The multipliers of linearised contact as functions of the displacements: elimination from a linear system, and recovery.

#include <functional>
#include <memory>
#include <utility>

#include "mortise/contact/decoupling.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

namespace detail {
struct Condensation;
}  // namespace detail

/// Rows G z with z gone:  G z = G S dd + G b.
struct SubstitutedRows {
  RCP<Matrix> of_dofs;   ///< G S [rows of G x dofs], to be added to a matrix
  RCP<Vector> constant;  ///< G b, to be taken from a right-hand side
};

/// Multipliers eliminated node by node. At an iterate (d, z^k) Newton's method asks for dd and the next z:
///   K~ dd + B z = rhs,                                B z = f_c = [ 0 | -M^T z | D^T z ] on (others | masters | slaves),
///   C_d dd + C_z (z - z^k) + L(dd, z - z^k) = -C.
/// Here K~ = K + C~, and rhs is -r without f_c. Each closed slave node j gives its multiplier as  z_j = b_j + S_j dd:
///   by its momentum   z_j = D_jj^-1 (rhs_j - K~_j dd)              where D is diagonal; its rows then hold its conditions,
///   by its law        z_j = z_j^k - C_z,j^-1 (C_j + C_d,j dd)      its rows stay momentum.
/// Open nodes have z_j = 0. With that in the rows where z stands, the condensed system  A dd = right  is left:
///   A = K~ + B S,   right = rhs - B b.
/// L is the dependence of the conditions of hardly covered nodes on multipliers of other nodes, also of other ranks (docs/contact.md). A does not
/// have it, as its pattern would widen. solve() and complete() add it: they give Newton's step whatever is covered.
///
/// S belongs to the matrix, b to a right-hand side. A value: copies share S. Collective in all members.
class NodeElimination {
 public:
  /// dd from a right-hand side, of the condensed matrix with its rows of prescribed dofs: dd = A^-1 right.
  using Solve = std::function<void(const Vector& right, Vector& dd)>;
  /// Tolerance of complete(): to round-off.
  static constexpr double exact = 1e-13;

  /// Condenses a further right-hand side, of the same matrix and conditions, and gives the elimination with its b.
  NodeElimination apply(Vector& rhs) const;
  /// Condenses any right-hand sides of both rows:  K~ dd + B dz = rhs,  C_d dd + C_z dz + L(dd, dz) = -C.  In the elimination that it gives z is dz,
  /// and z^k is 0.
  NodeElimination apply(Vector& rhs, const Vector& C) const;

  /// z = b + S dd, from the whole increment, with that of prescribed dofs.
  void recover(const Vector& dd, Vector& z) const;

  /// Eliminates z from other rows than those of f_c: any equations into which multipliers enter, such as those of the heat of friction.
  /// @param G  filled [any rows, each on one rank, x multipliers]; not in rows of slave nodes' displacements
  /// @throws std::logic_error for a domain that is not the map of multipliers
  SubstitutedRows substitute(const Matrix& G) const;

  /// Newton's step (dd, dz), dz = z - z^k, with L. It takes one solve where L is 0, else a few more.
  /// @param right      condensed; with the rows of prescribed dofs as the host has them
  /// @param solve      also called with other right-hand sides, in which rows are 0 that ContactSystem was told to be prescribed
  /// @param further    G in rows of dofs, whose G S the host has added to A, and whose G b it has taken from `right`; null: none
  /// @param tolerance  of the rows of L over what the condensed step leaves of them
  void solve(const Vector& right, const Solve& solve, Vector& dd, Vector& dz, const Matrix* further = nullptr, double tolerance = exact) const;
  /// The part of solve() after its first solve: from the dd of the condensed system to (dd, dz). A host calls it whose first solve differs from those
  /// that follow, as where it prescribes increments by other means than rows of A.
  void complete(const Solve& solve, Vector& dd, Vector& dz, const Matrix* further = nullptr, double tolerance = exact) const;

  /// Data of A for multigrid.
  Decoupling decoupling() const;

 private:
  friend class ContactLinearisation;
  NodeElimination(std::shared_ptr<const detail::Condensation> condensation, RCP<const Vector> b, RCP<const Vector> z)
      : condensation_(std::move(condensation)), b_(std::move(b)), z_(std::move(z)) {}
  std::shared_ptr<const detail::Condensation> condensation_;
  RCP<const Vector> b_;  ///< [multipliers]
  RCP<const Vector> z_;  ///< z^k; null: 0
};

}  // namespace mortise
