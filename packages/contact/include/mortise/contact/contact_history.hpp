#pragma once
// Memory of contact of the last accepted state: plain data of the owned slave nodes, in the order of MortarInterface::slave_nodes().

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "mortise/contact/complementarity.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// States of the nodes of a pair, [owned slave nodes].
struct PairStates {
  std::vector<ContactState> states;  ///< open, stick or slip
  std::vector<char> covered;         ///< true if a multiplier has anything to act on
};
/// [pairs]
using ContactStates = std::vector<PairStates>;

/// References of slips, [owned slave nodes]: the couplings of an accepted state.
struct SlipReferences {
  RetainedNodes nodes;                            ///< nodes it was coupled to, itself among them; none: it was hardly covered, or not at all
  std::vector<std::vector<double>> coefficients;  ///< of these nodes: rows of D and -M
  std::vector<TangentVector> positions;           ///< tau_a . sum_m c_jm x_m; empty unless the geometry is that of the reference configuration
  std::vector<TangentVector> ties;                ///< tau_a . q, what its tie shifted the slip by; empty: open, or not tied
  std::vector<TangentVector> tractions;           ///< tau_a . z of closed nodes with prescribed components; else empty
  std::vector<double> paths;                      ///< slipped until then [length]
  std::vector<double> gaps;                       ///< that they close first; -1: a node without `nodes` that was covered, and closes none
  RCP<const MultiVector> start;                   ///< [owned nodes x dim] positions in that state
};

/// Start of the conditions of a node where Enforcement::starts_from_multipliers(): fixed while they are solved, renewed by an update of the
/// multipliers and by a step.
struct NodeStart {
  SpatialVector multiplier;  ///< normal, along tau_a: Enforcement::start_from()
  double stiffening = 1.0;   ///< factor of eps: Enforcement::stiffening()
};

/// Stiffness of the bodies as updates of the multipliers have shown it.
struct Settling {
  double hardening = 1.0;       ///< factor of eps of all nodes: how much stiffer than facets the bodies are
  std::optional<double> ratio;  ///< their stiffness against the slowest of the changes, over eps; none: not known yet
  double last_change = 0.0;     ///< of the multipliers in the round before, at the present stiffness [stress]
};

/// History of a pair.
struct PairHistory {
  std::vector<int> axes;                       ///< [owned slave nodes] reference axis of the tangents
  SurfaceKinks kinks;                          ///< of the slave surface
  std::vector<SurfaceFacet> nearest_facets;    ///< [owned slave nodes] the facet nearest to the master; empty but with the rule `nearest facet`
  std::shared_ptr<const SlipReferences> slip;  ///< null without friction
  std::vector<NodeStart> starts;               ///< [owned slave nodes]; empty unless Enforcement::starts_from_multipliers()
  Settling settling;                           ///< of the updates of the multipliers
  double allowed_overlap = 0.0;                ///< overlap that the surfaces may have without pressure [length]
  std::vector<double> clearances;              ///< [owned slave nodes] added to the gap [length]; empty: none
  std::vector<double> start_gaps;  ///< [owned slave nodes] mean gaps at the start of a step, 0: not covered; empty: conditions are on gaps
  double constant_share = 1.0;     ///< factor of complementarity constants within the step
};

/// An accepted state, as the next step needs it.
struct AcceptedContact {
  std::vector<PairHistory> pairs;    ///< [pairs]
  ContactStates states;              ///< of their nodes
  RCP<const MultiVector> positions;  ///< [owned nodes x dim]
  RCP<const Vector> multipliers;     ///< z
  std::size_t layout = 0;            ///< digest of the slave nodes on this rank, by which another system's is known; 0: not known
};

/// The history of contact: an immutable value, cheap to copy. ContactSystem makes new ones: at the start, by commit(), and within a step by
/// start_step(), augment() and allow_overlap(). Whoever keeps an old one can go back to it.
class ContactHistory {
 public:
  /// @param accepted  as an earlier history had it, with nodes on the same ranks
  explicit ContactHistory(AcceptedContact accepted) : accepted_(std::make_shared<const AcceptedContact>(std::move(accepted))) {}
  const AcceptedContact& operator*() const { return *accepted_; }    ///< its data
  const AcceptedContact* operator->() const { return &*accepted_; }  ///< its data

 private:
  std::shared_ptr<const AcceptedContact> accepted_;
};

}  // namespace mortise
