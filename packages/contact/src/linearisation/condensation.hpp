#pragma once
// Multipliers condensed into the bodies' system, and the data that recovers them.

#include <array>
#include <memory>
#include <vector>

#include "evaluation/evaluated_contact.hpp"

namespace mortise::detail {

/// The affine map z = b + S dd of a closed node. Columns of S are the local ones of the system.
struct EliminatedNode {
  LocalOrdinal multiplier = 0;  ///< local index of the first component in z
  std::vector<LocalOrdinal> columns;
  std::array<std::vector<double>, 3> S;  ///< [dim]

  // Data that makes b, and the node's right-hand side, from residuals. Of a node that is eliminated by its law  b = z - C_z^-1 C.
  std::size_t pair = 0, node = 0;
  bool by_law = false;
  SpatialMatrix inverse;         ///< C_z^-1; else E^-1 of condense_node()
  SpatialMatrix C_z, axes;       ///< [conditions x dim]; rows of `axes`: n, tau_a
  std::array<int, 3> condition;  ///< [dim] the condition in place of the momentum of a fixed component; -1: none
};

/// The elimination of all nodes from one matrix.
struct Condensation {
  ContactLaws laws;
  std::shared_ptr<SystemScatter> scatter;
  std::vector<EliminatedNode> nodes;  ///< closed ones
  TieBlocks left_out;                 ///< L; null: nothing is

  const EvaluatedLaws& at() const { return evaluated(laws); }
  const ContactModel& model() const { return *at().contact->model; }
  const PairEvaluation& pair(std::size_t p) const { return at().contact->pairs[p]; }
  /// Local rows of the components of an owned slave node, -1: no unknown.
  const LocalOrdinal* own_rows_of(const SlaveNode& slave) const {
    return &model().rows[static_cast<std::size_t>(model().dimension * slave.owned_node)];
  }

  /// A row of an owned slave node that holds a condition; -1: none of its components is free.
  LocalOrdinal free_row(const EliminatedNode& node) const {
    const SlaveNode& slave = pair(node.pair).slave_nodes()[node.node];
    for (int i = 0; i < model().dimension; ++i)
      if (!slave.fixed[i]) return own_rows_of(slave)[i];
    return -1;
  }

  void condense_node(std::size_t pair, std::size_t s, Matrix& system);
  void eliminate_by_law(std::size_t pair, std::size_t s, Matrix& system);
  /// b of a node with the multiplier z and the conditions C. Changes the node's part of the right-hand side.
  SpatialVector condense_right_hand_side(const EliminatedNode& node, const SpatialVector& z, const SpatialVector& C, Vector& rhs) const;
  /// Open nodes in whose rows C is not 0.
  std::vector<EliminatedNode> open_nodes(const Vector& C) const;
  /// b of all nodes. Condenses the right-hand side.
  /// @param C  null: that of the iterate, for z^{k+1}; else for an increment of z
  RCP<Vector> condense_right_hand_side(const Vector* C, Vector& rhs) const;
  /// S [multipliers x dofs].
  RCP<Matrix> slopes() const;
};

/// Adds the stiffness of a pair of variational mortar beyond what the facets' dD and dM give, as ContactLinearisation::add_stiffness() asks.
void add_gap_stiffness(const EvaluatedLaws& laws, std::size_t pair, SystemScatter& scatter, Matrix& system);

}  // namespace mortise::detail
