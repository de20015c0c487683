#pragma once
// Elimination of unknowns that follow from others.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/core/dependence.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/affine_constraints.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// Independent unknowns q of d = P (q, g(q)) + p(t): g of rigid constraints, P and p of affine ones. The unknowns q are numbered without gaps, in
/// the order of the dofs. Tied dofs keep their numbers, for multigrid wants whole nodes: their columns of P are empty, and their increments
/// prescribed as 0.
class Reduction {
 public:
  /// `local_dofs`: owned dofs, then ghosts, as rigid constraints want them. One of `followers` and `constraints` may be null; the latter
  /// have a T. Collective.
  Reduction(std::shared_ptr<const RigidConstraints> followers, std::shared_ptr<const AffineConstraints> constraints,
            std::function<void(const Vector&, Vector&)> put_support_forces, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs);

  /// Map of q.
  const RCP<const Map>& unknowns() const { return unknowns_; }
  /// Owned dofs that follow or are tied, ascending.
  const std::vector<LocalOrdinal>& dependents() const { return dependents_; }
  /// Local indices in unknowns(), ascending, of owned dofs that are prescribed, none of which follows, and of those that are tied.
  std::vector<LocalOrdinal> held_places(const std::vector<LocalOrdinal>& prescribed) const;

  /// v on unknowns().
  RCP<Vector> unknown_part(const Vector& v) const;
  /// Data of the unknowns for multigrid, from that of the dofs. Every node has to follow as a whole or not at all.
  NearNullSpace reduced(const NearNullSpace& of_dofs) const;
  /// Fields of the unknowns, from those of the dofs.
  FieldsOfRows reduced(const FieldsOfRows& of_dofs) const;
  /// Decoupling of the unknowns, from that of the dofs, which has to leave followers out. Collective.
  Decoupling reduced(const Decoupling& of_dofs) const;

 private:
  friend class FollowedUnknowns;
  RCP<MultiVector> unknown_rows(const MultiVector& v) const;
  std::vector<Dependence> evaluate(const Vector& local_unknowns) const;

  std::shared_ptr<const RigidConstraints> followers_;
  std::shared_ptr<const AffineConstraints> constraints_;
  std::function<void(const Vector&, Vector&)> put_support_forces_;  ///< SystemParts::put_support_forces
  std::vector<LocalOrdinal> following_, dependents_;
  RCP<const Map> dofs_, unknowns_;
  std::vector<LocalOrdinal> place_of_;                                ///< [owned dofs] in unknowns(), -1: follows
  std::vector<std::array<GlobalOrdinal, Dependence::most>> sources_;  ///< [followers] ids in unknowns()
  RCP<const Graph> graph_;                                            ///< of d(q, g(q))/dq
  RCP<const Matrix> constant_T_;                                      ///< where nothing follows; else null
};

/// P (q, g(q)) + p and its derivatives at some unknowns. With T = dd/dq a residual r(d) = 0 becomes T^T r = 0. Its linearisation, with
/// d0 = P (q, g(q)) + p - d,  is
///   (T^T A T + sum_i (P^T r)_i d2g_i/dq2) dq = T^T (rhs - A d0),   dd = T dq + d0.
/// d0 is 0 but on followers and tied dofs. Collective in all members.
class FollowedUnknowns {
 public:
  /// Where p has no value it is NaN, and so are deviations; failure() says why.
  FollowedUnknowns(std::shared_ptr<const Reduction> reduction, double time, const Vector& local_unknowns);

  const std::optional<StepFailure>& failure() const { return failure_; }

  /// Largest |d0| over this rank, and `deviation`_i = -factor d0_i on followers and tied dofs. `deviation` keeps its other entries.
  double deviation(const Vector& unknowns, double factor, Vector& deviation) const;

  /// r becomes T^T r on the dofs that are unknowns, 0 on those that are tied, and on followers what they bear with all that is tied to them.
  void gather(Vector& r) const;
  /// Forces as after gather(), but with what supports bear at the nodes that they hold.
  RCP<Vector> support_forces(const Vector& r) const;
  /// T^T r on the unknowns.
  RCP<Vector> reduced(const Vector& r) const;
  /// T dq on the dofs.
  RCP<Vector> expanded(const Vector& dq) const;
  /// P (d2g/dq2 : rate x rate), the acceleration of the dofs where q has none.
  RCP<Vector> convected(const Vector& rate) const;

  /// T^T A T + sum_i (P^T r)_i d2g_i/dq2, with all diagonal entries of tied dofs and of dofs that others follow in its graph.
  RCP<Matrix> reduced(const Matrix& A, const Vector& r) const;
  /// T^T B and C T.
  RCP<Matrix> reduced_rows(const Matrix& B) const;
  RCP<Matrix> reduced_columns(const Matrix& C) const;

  /// y += (sum_i (P^T r)_i d2g_i/dq2) v on the dofs.
  void add_curvature(const Vector& r, const Vector& v, Vector& y) const;

 private:
  RCP<Matrix> curvature(const Vector& r) const;
  /// P^T r
  RCP<const Vector> untied(const Vector& r) const;

  std::shared_ptr<const Reduction> reduction_;
  std::vector<Dependence> dependences_;
  RCP<const Matrix> T_;
  RCP<const Vector> offset_;  ///< p; null: 0
  std::optional<StepFailure> failure_;
};

}  // namespace mortise::detail
