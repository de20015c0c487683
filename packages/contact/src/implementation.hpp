#pragma once
// What ContactSystem holds.

#include <Eigen/Core>
#include <Tpetra_MultiVector.hpp>
#include <algorithm>
#include <array>
#include <map>
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

  // What makes b, and the node's right-hand side, from residuals. Of a node that is eliminated by its law  b = z - C_z^-1 C.
  std::size_t pair = 0, node = 0;
  bool by_law = false;
  SpatialVector z, C;            ///< of the iterate
  SpatialMatrix inverse;         ///< C_z^-1; else E^-1 of condense_node()
  SpatialMatrix C_z, axes;       ///< [conditions x dim]; rows of `axes`: n, tau_a
  std::array<int, 3> condition;  ///< [dim] which of the conditions stands in the place of the momentum of a fixed component; -1: none
};

struct ContactSystem::Implementation {
  /// Derivatives with respect to z [z x z] and to d [z x dofs].
  struct TieBlocks {
    RCP<Matrix> of_multipliers, of_positions;
  };

  RCP<const Map> owned_nodes, dofs, multipliers;
  RCP<const MultiVector> reference, fixed;
  Timers timers;
  int dimension = 2;
  double extent = 0.0;  ///< largest coordinate of the reference positions
  /// To which gaps and slips are known.
  double position_round_off() const { return 4.0 * std::numeric_limits<double>::epsilon() * extent; }
  std::vector<std::unique_ptr<detail::PairCoupling>> pairs;
  std::vector<std::vector<LocalOrdinal>> multiplier_of;     ///< [pair][slave node] local index of the first component in z, -1: none
  std::vector<std::vector<ContactState>> marked, accepted;  ///< [pair][slave node] when last marked, of the accepted state
  std::vector<std::vector<LocalOrdinal>> master_nodes;      ///< [pair] local indices in owned_nodes
  std::unique_ptr<detail::SystemScatter> scatter;
  bool pattern_changed = true;
  bool has_derivatives = false;  ///< of the last evaluation
  bool middles_first = false;    ///< there are multipliers that are condensed before others, on any rank
  std::vector<RecoveryRow> recovery;
  std::size_t middles_condensed = 0;  ///< the first of them
  TieBlocks left_out;                 ///< L at the last condense(); null: nothing is

  RCP<const MultiVector> evaluated_at, accepted_at;  ///< positions of the last evaluation, of the accepted state; null: none yet
  RCP<const Vector> accepted_multipliers;            ///< null: none yet, so that all are 0

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
  /// Multipliers of the owned slave nodes of a pair and what they are tied by, from a host view of z. Collective where there are ties.
  template <class View>
  std::vector<detail::NodeMultiplier> multipliers_of(const View& z, std::size_t pair) const {
    std::vector<detail::NodeMultiplier> result;
    for (std::size_t s = 0; s < multiplier_of[pair].size(); ++s) result.emplace_back(z_of(z, pair, s));
    if (pairs[pair]->ties().any()) add_ties(pair, *owned_multipliers(pair, z), result);
    return result;
  }
  void add_ties(std::size_t pair, const MultiVector& z, std::vector<detail::NodeMultiplier>& multipliers) const;
  /// z of the owned slave nodes of a pair [x dim], on MultiplierTies::owned_nodes().
  template <class View>
  RCP<MultiVector> owned_multipliers(std::size_t pair, const View& z) const {
    const auto result = rcp(new MultiVector(pairs[pair]->ties().owned_nodes(), static_cast<std::size_t>(dimension)));
    const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t s = 0; s < multiplier_of[pair].size(); ++s) {
      const SpatialVector zs = z_of(z, pair, s);
      for (int i = 0; i < dimension; ++i) view(s, i) = zs[i];
    }
    return result;
  }
  void condense_node(std::size_t pair, std::size_t s, const detail::NodeMultiplier& multiplier, Matrix& system);
  void eliminate_by_law(std::size_t pair, std::size_t s, const detail::NodeMultiplier& multiplier, Matrix& system);
  void add_right_hand_side(RecoveryRow& row, const SpatialVector& z, const SpatialVector& C, Vector& rhs);
  /// @param C  null: that of the iterate, for z^{k+1}; else for an increment of z
  void condense_right_hand_side(const Vector* C, Vector& rhs);
  /// Of q.
  TieBlocks tie_blocks(const Vector& z) const;
  /// L of tied_conditions.cpp; null where no tied node is in contact. Collective.
  /// @param of_nodes  [pair][slave node]
  TieBlocks tied_conditions(const Vector& z, const std::vector<std::vector<detail::NodeMultiplier>>& of_nodes) const;
  bool any_ties() const {
    return std::any_of(pairs.begin(), pairs.end(), [](const auto& pair) { return pair->ties().any(); });
  }
  /// From the last evaluation, that of the accepted state, and the accepted multipliers.
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
