#pragma once
// What ContactSystem holds.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "mortise/contact/complementarity.hpp"
#include "mortise/contact/contact_system.hpp"
#include "pair_coupling.hpp"
#include "system_scatter.hpp"

namespace mortise {

/// The affine map z^{k+1} = b + S dd of a closed node, kept by condense() for recover(). Rows of S stand in the local columns of the system.
struct RecoveryRow {
  LocalOrdinal multiplier = 0;  ///< local index of the first component in z
  SpatialVector b;
  std::vector<LocalOrdinal> columns;
  std::array<std::vector<double>, 3> S;  ///< [dim]
};

struct ContactSystem::Implementation {
  RCP<const Map> owned_nodes, dofs, multipliers;
  RCP<const MultiVector> reference, fixed;
  Timers timers;
  int dimension = 2;
  double extent = 0.0;  ///< largest coordinate of the reference positions
  std::vector<std::unique_ptr<detail::PairCoupling>> pairs;
  std::vector<std::vector<LocalOrdinal>> multiplier_of;     ///< [pair][slave node] local index of the first component in z, -1: none
  std::vector<std::vector<ContactState>> marked, accepted;  ///< [pair][slave node] when last marked, of the accepted state
  std::vector<std::vector<LocalOrdinal>> master_nodes;      ///< [pair] local indices in owned_nodes
  std::unique_ptr<detail::SystemScatter> scatter;
  bool pattern_changed = true;
  bool has_derivatives = false;  ///< of the last evaluation
  bool middles_first = false;    ///< there are multipliers that are condensed before others, on any rank
  std::vector<RecoveryRow> recovery;

  RCP<const MultiVector> evaluated_at, accepted_at;  ///< positions of the last evaluation, of the accepted state; null: none yet

  void evaluate(const RCP<const MultiVector>& x, bool derivatives, std::optional<StepFailure>& failure);
  /// The last evaluation was that of the accepted state.
  void accept_cover();
  /// Positions X + d on the owned nodes.
  RCP<MultiVector> positions(const Vector& d) const;
  /// z of slave node s of a pair (0 without multiplier), from a host view of z.
  template <class View>
  SpatialVector z_of(const View& z, std::size_t pair, std::size_t s) const {
    SpatialVector result = SpatialVector::Zero(dimension);
    if (const LocalOrdinal first = multiplier_of[pair][s]; first >= 0)
      for (int i = 0; i < dimension; ++i) result[i] = z(first + i, 0);
    return result;
  }
  void add_contact_force(const Vector& z, Vector& r) const;
  /// What add_stiffness() adds for a pair of variational mortar beyond what the facets' dD and dM give.
  void add_gap_stiffness(std::size_t pair, const Vector& z, Matrix& system);
  void condense_node(std::size_t pair, std::size_t s, const Vector& z, Matrix& system, Vector& rhs);
  void eliminate_by_law(std::size_t pair, const Vector& z, Matrix& system, Vector& rhs);
  void take_slip_references();
  std::vector<std::vector<ContactState>> states(const Vector& z) const;
  /// Collective. Positions x on the owned nodes: those of the last evaluation.
  void find_lost_contact(const MultiVector& x, std::optional<StepFailure>& failure) const;
  /// Throw std::logic_error on every rank, if `caller` was called too early.
  void require_linearisation(const char* caller) const;
  /// The same, and for a matrix that is no system to add to.
  void require_system(const char* caller, const Matrix& system) const;
  /// Sums over ranks.
  double sum(double value) const;
  double maximum(double value) const;
};

}  // namespace mortise
