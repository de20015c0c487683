#pragma once
// Elimination of displacements that follow from others.

#include <memory>
#include <vector>

#include "mortise/core/dependence.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// What of a displacement d = (q, g(q)) is an unknown. The unknowns q are numbered without gaps, in the order of the dofs.
class Reduction {
 public:
  /// `local_dofs`: owned dofs, then ghosts, as the followers want their displacement. Collective.
  Reduction(std::shared_ptr<const DependentDisplacements> followers, const RCP<const Map>& dofs, const RCP<const Map>& local_dofs);

  /// Map of q.
  const RCP<const Map>& unknowns() const { return unknowns_; }
  /// Local indices in unknowns() of owned dofs, none of which follows.
  std::vector<LocalOrdinal> places(const std::vector<LocalOrdinal>& dofs) const;

  /// v on unknowns().
  RCP<Vector> unknown_part(const Vector& v) const;
  /// What multigrid is told of the unknowns, from what it would be told of the dofs. Every node has to follow as a whole or not at all.
  NearNullSpace reduced(const NearNullSpace& of_dofs) const;
  /// Likewise; the decoupling has to leave followers out. Collective.
  Decoupling reduced(const Decoupling& of_dofs) const;

 private:
  friend class FollowedDisplacements;
  RCP<MultiVector> unknown_rows(const MultiVector& v) const;

  std::shared_ptr<const DependentDisplacements> followers_;
  RCP<const Map> dofs_, unknowns_;
  std::vector<LocalOrdinal> place_of_;                                ///< [owned dofs] in unknowns(), -1: follows
  std::vector<std::array<GlobalOrdinal, Dependence::most>> sources_;  ///< [followers] ids in unknowns()
  RCP<const Graph> graph_;                                            ///< of T
};

/// g and its derivatives at a displacement. With T = dd/dq a residual r(d) = 0 becomes T^T r = 0. Its linearisation is
///   (T^T A T + sum_i r_i d2g_i/dq2) dq = T^T (rhs - A d0),   d0 = g(q) - d on the followers and 0 elsewhere,   dd = T dq + d0.
/// Collective in all members but deviation().
class FollowedDisplacements {
 public:
  FollowedDisplacements(std::shared_ptr<const Reduction> reduction, const Vector& local_displacement);

  /// Largest |d - g| over this rank, and `deviation`_i = factor (d_i - g_i) on followers. `deviation` keeps its other entries.
  double deviation(const Vector& displacement, double factor, Vector& deviation) const;

  /// r becomes T^T r on the dofs that are unknowns and stays on followers.
  void gather(Vector& r) const;
  /// T^T r on the unknowns.
  RCP<Vector> reduced(const Vector& r) const;
  /// T dq on the dofs.
  RCP<Vector> expanded(const Vector& dq) const;

  /// T^T A T + sum_i r_i d2g_i/dq2, with all diagonal entries of dofs that others follow in its graph.
  RCP<Matrix> reduced(const Matrix& A, const Vector& r) const;
  /// T^T B and C T.
  RCP<Matrix> reduced_rows(const Matrix& B) const;
  RCP<Matrix> reduced_columns(const Matrix& C) const;

  /// y += (sum_i r_i d2g_i/dq2) v on the dofs.
  void add_curvature(const Vector& r, const Vector& v, Vector& y) const;

 private:
  RCP<Matrix> curvature(const Vector& r) const;

  std::shared_ptr<const Reduction> reduction_;
  std::vector<Dependence> dependences_;
  RCP<Matrix> T_;
};

}  // namespace mortise::detail
