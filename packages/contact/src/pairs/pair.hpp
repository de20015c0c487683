#pragma once
// One contact pair: what does not change with the configuration, and its integrals at one.

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "mortise/contact/contact_history.hpp"
#include "mortise/contact/contact_pair.hpp"
#include "mortise/contact/enforcement.hpp"
#include "pairs/pair_geometry.hpp"
#include "pairs/pair_history.hpp"

namespace mortise::detail {

/// Distance over h up to which nodes of a body that only contact holds count as about to close.
constexpr double near = 0.1;

/// A pair and its interface. The interface keeps candidates, communication plans and the geometry of the reference configuration from call to call;
/// values do not depend on them. Collective in all members but the accessors.
class Pair {
 public:
  Pair(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed, const InterfaceMeasure& measure, ContactPair pair);

  /// 2 or 3.
  int dimension() const { return dimension_; }
  const ContactPair& definition() const { return pair_; }
  const Enforcement& enforcement() const { return *enforcement_; }
  /// True if normal forces are the gaps' derivatives; then rows hold these after each evaluation.
  bool has_forces_of_gaps() const { return pair_.options.mortar.coupling->has_forces_of_gaps(); }
  /// Null: the pair has no friction.
  const FrictionLaw* friction() const { return friction_; }
  const MortarInterface& interface() const { return *interface_; }
  const std::vector<SlaveNode>& slave_nodes() const { return interface_->slave_nodes(); }
  /// Rule at kinks of the slave surface: averaged where the geometry is frozen.
  CornerRule corner_rule() const;
  /// True if the geometry is that of the reference configuration.
  bool uses_reference() const { return pair_.options.geometry == ContactGeometry::reference; }
  /// Element size h of the scaling and of the start rule.
  double size() const { return size_; }
  /// c_n of slave node s: unless given E / (h A_j) times Enforcement::relative_constant().
  double complementarity_constant(std::size_t s) const;
  /// c of exact conditions for slips and for the pressure of friction's bound: that, but at most E / (h A_j).
  double friction_constant(std::size_t s) const;
  /// True if the multiplier of slave node s acts in momentum rows of corners and is condensed before theirs: that of a mid-side node.
  bool before_corners(std::size_t s) const { return slave_nodes()[s].middle && enforcement_->needs_diagonal_coupling(); }
  /// True if hardly covered nodes are tied.
  bool has_ties() const { return pair_.options.full_cover > 0.0 && enforcement_->takes_ties(); }
  /// True if slave node s has a multiplier and its function anything to act on: D_jj > 0, of standard multipliers sum_k D_jk. Round-off of a
  /// facet that is not covered is no part of it: see FacetMoments.
  bool covered(std::size_t s, const NodeRow& row) const;
  /// True if conditions depend on what is covered of a node.
  bool needs_covered() const { return enforcement_->depends_on_weight() || has_clearances() || pair_.has_conditions_on_rate; }
  /// True if anything is added to the gaps that are drawn.
  bool has_clearances() const { return pair_.options.clearance.has_value() || pair_.facet_gaps != nullptr; }
  /// Number of slip measurements on this rank, over all calls.
  long slip_evaluations() const { return slip_evaluations_; }

  /// The history before anything was evaluated: no reference for slips, and axes of the tangents of partly fixed nodes only.
  PairHistory blank_history() const;
  /// The kinks for a step that starts at the positions x [owned nodes x dim] of an accepted state.
  SurfaceKinks choose_kinks(const MultiVector& x, const PairHistory& history) const;
  /// Finds candidates at the positions x [owned nodes x dim].
  void search(const MultiVector& x, const PairHistory& history) const;
  /// Evaluates at x, the positions of the last search(). Failures of this rank go to `failure`.
  std::shared_ptr<const PairGeometry> evaluate(const MultiVector& x, const PairHistory& history, bool derivatives,
                                               std::optional<StepFailure>& failure) const;
  /// Where normal forces are the gaps' derivatives: second derivatives of sum_j z_n,j g_j. None of frozen geometry.
  /// @param x  [owned nodes x dim] where `geometry` was evaluated, with `history`
  std::vector<GapCurvature> gap_curvatures(const MultiVector& x, const PairGeometry& geometry, const PairHistory& history,
                                           const std::vector<double>& pressures) const;

 private:
  using Places = std::vector<std::vector<LocalOrdinal>>;

  void refuse_constant_out_of_range() const;
  void refuse_reach_short_of_onset() const;
  std::vector<NodeRow> rows_of(const InterfacePattern& pattern, const std::vector<FacetCoupling>& couplings, const std::vector<NodalNormal>& normals,
                               bool derivatives, std::vector<double>& gaps) const;
  void measure_covered(const InterfacePattern& pattern, const std::vector<FacetCoupling>& couplings, std::vector<NodeRow>& rows) const;
  void freeze(const InterfacePattern& pattern, std::vector<NodeRow>& rows) const;
  std::shared_ptr<const PairGeometry> moved(const MultiVector& x, const PairHistory& history) const;
  /// Of the nodes that slips are measured against, among the coupled nodes. Sets start_ too.
  const Places& places_of(const std::shared_ptr<const InterfacePattern>& pattern, const std::shared_ptr<const SlipReferences>& references) const;
  void measure_slip(const PairHistory& history, bool derivatives, PairGeometry& geometry) const;
  void measure_first_slip(const PairHistory& history, bool derivatives, PairGeometry& geometry) const;
  void find_resting(PairGeometry& geometry) const;
  void measure_frozen_slip(const PairHistory& history, PairGeometry& geometry) const;

  ContactPair pair_;
  RCP<const Map> owned_nodes_;
  RCP<const MultiVector> reference_, fixed_;
  std::unique_ptr<MortarInterface> interface_;
  MultiplierTies untied_;
  const FrictionLaw* friction_ = nullptr;
  SharedEnforcement enforcement_;
  std::vector<int> fixed_axes_;        ///< [slave nodes] first component that is prescribed; -1: none
  std::set<GlobalOrdinal> slave_ids_;  ///< nodes of the slave facets of this rank; only where any_held_
  bool any_held_ = false;              ///< with friction: slave nodes have prescribed components, on any rank
  double size_ = 1.0;
  int dimension_ = 2;

  // Kept from call to call.
  mutable std::shared_ptr<const PairGeometry> frozen_;  ///< at the reference configuration; null: not evaluated yet
  mutable std::optional<StepFailure> frozen_failure_;   ///< of that evaluation
  mutable long slip_evaluations_ = 0;
  mutable Places places_;
  mutable RCP<const MultiVector> start_;  ///< [local nodes x dim] positions in the state that slips are measured from
  mutable RCP<const MultiVector> held_;   ///< [local nodes x dim] what is prescribed; only where any_held_
  mutable std::shared_ptr<const InterfacePattern> places_pattern_;
  mutable std::shared_ptr<const SlipReferences> places_references_;
};

}  // namespace mortise::detail
