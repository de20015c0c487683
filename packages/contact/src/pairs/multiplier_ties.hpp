#pragma once
// Multipliers of hardly covered slave nodes are tied to those of their neighbours: a ghost penalty on multipliers.
//
// Where the master ends a small part of a facet into it, the multipliers of the far nodes act on next to nothing. A force F takes the multiplier F /
// D_bb, however small D_bb is. The tie of such a node b resists the deviation r_b of its multiplier from a mean of its neighbours':
//   r_b = z_b - sum_k T_bk z_k,   sum_k T_bk = 1.
// Ties have the energy sum_b sigma_b |r_b|^2 / 2 with the gradient
//   q_j = sum_b s_bj sigma_b r_b,   s_bb = 1,   s_bk = -T_bk,
// a length times a weight. With rows of T_j the tangents, weighted gap and slip become
//   g_j + n_j . q_j,   u_j - (T_j q_j - T_j^old q_j^old).
// A gap is absolute and a slip one since the start of the step, ^old: so are their ties.
// Forces, D and M are what they are. Where hardly anything is covered, g_b ~ 0 leaves z_b -> sum_k T_bk z_k. The node's condition goes to its
// neighbours, whose gaps become g_k + T_bk g_b: redistribution is the limit. Equal multipliers have r = 0: patch tests stay exact.
//
// The factors are functions of the state, C^1 in the cover from 0 to 1.
//   c_b^2 = sum_e (c^e_b)^2,   w_b = s^2 (3 - 2 s),   s = min(1, c_b / c_0),   sigma_b = (1 - w_b) a_b A_b h / E,
//   T_bk = sum_e (d^e_b / sum_e' d^e'_b) (c^e_k + eta C) / sum_k' (c^e_k' + eta C),   d^e_b = int_e phi_b,   C = sum_k' c^e_k'.
// Here c^e is the covered share FacetCoupling::cover, and k are the neighbours of b along the edges of facet e that carry multipliers. A node that a
// whole facet covers is not tied. One beside the aligned edge of a master is not tied either. The factor
//   a_b = sum_e d^e_b a^e / sum_e d^e_b
// leaves out sides that stand off at a corner. FacetCoupling::alignment a^e falls from 1 to 0 while facet e at a kink rises from the master by 10 to
// 20 degrees. The open node at the far end of such a side has no pressure to be compared with that of the corner. References: Burman (C. R. Math.
// 348, 2010) for the ghost penalty of cut elements.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "mortise/core/spatial.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise::detail {

/// A hardly covered node and what its multiplier is tied to.
struct MultiplierTie {
  std::size_t node = 0;                 ///< b, owned slave node
  double compliance = 0.0;              ///< sigma_b
  std::vector<LocalOrdinal> receivers;  ///< k, in MultiplierTies::nodes()
  std::vector<double> shares;           ///< [receivers] T_bk
  std::vector<LocalOrdinal> columns;    ///< local nodes of the interface that the values depend on
  Eigen::RowVectorXd dcompliance;       ///< [dim columns]; empty without derivatives
  Eigen::MatrixXd dshares;              ///< [receivers x dim columns]; empty without derivatives
};

/// The ties of the slave nodes of one pair. Collective in all members but the accessors.
class MultiplierTies {
 public:
  MultiplierTies() = default;
  /// @param slave  every slave facet with a node owned by this rank, by ids
  MultiplierTies(const std::vector<SlaveNode>& owned, const SurfaceFacets& slave, const RCP<const Communicator>& comm);

  /// Ties of the current couplings.
  /// @param covered  whether an owned node has anything to act on; others have multipliers of 0 and take no part
  /// @param full_cover  c_0; 0: there are none
  /// @param softness    h / E [length / stress]
  /// @param derivatives  which the couplings then have to have
  void measure(const std::vector<FacetCoupling>& couplings, const std::vector<SlaveNode>& owned, const std::function<bool(std::size_t)>& covered,
               const Map& local_nodes, double full_cover, double softness, int dimension, bool derivatives);

  /// True if there are any, on any rank.
  bool any() const { return any_; }
  const std::vector<MultiplierTie>& ties() const { return ties_; }
  /// Owned slave nodes, then the others of their facets, by id.
  const RCP<const Map>& nodes() const { return nodes_; }
  /// Owned slave nodes, by id.
  const RCP<const Map>& owned_nodes() const { return owned_; }

  /// z of all nodes() from z of owned ones [owned x dim].
  RCP<MultiVector> on_nodes(const MultiVector& z) const;
  /// q_j of owned nodes from z of all nodes() [x dim].
  RCP<MultiVector> gradient(const MultiVector& z_on_nodes, int dimension) const;
  /// Derivative of q_j with respect to z_j, the same for all components [owned]. 0: no tie has to do with the node.
  std::vector<double> diagonal() const;
  /// sigma_b of an owned node; 0: it is not tied.
  double compliance(std::size_t s) const { return compliance_.empty() ? 0.0 : compliance_[s]; }

  /// r_b.
  static SpatialVector deviation(const MultiplierTie& tie, const MultiVector& z_on_nodes);

 private:
  RCP<MultiVector> summed(const MultiVector& on_nodes) const;

  RCP<const Map> owned_, nodes_;
  RCP<const Import> import_;
  std::vector<MultiplierTie> ties_;
  std::vector<double> compliance_;  ///< [owned]; empty: no ties here
  bool any_ = false;
};

}  // namespace mortise::detail
