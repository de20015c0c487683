#pragma once
// The conditions of one pair's nodes at one configuration, with one history.

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/complementarity.hpp"
#include "pairs/pair.hpp"

namespace mortise::detail {

/// |g_j| / (A_j h) below which a node touches: then the sign of g is round-off.
constexpr double touching = 1e-8;

/// The multiplier of a slave node as its conditions see it.
struct NodeMultiplier {
  SpatialVector z;
  SpatialVector shift;  ///< q_j of MultiplierTies; empty: 0
  double tie = 0.0;     ///< sigma_j

  NodeMultiplier(SpatialVector own) : z(std::move(own)) {}  // NOLINT(google-explicit-constructor): one without ties
};

/// A pair evaluated: its geometry seen with a history. Functions of these and of multipliers alone; `s` is an owned slave node.
class PairEvaluation {
 public:
  PairEvaluation(const Pair& pair, std::shared_ptr<const PairGeometry> geometry, ContactHistory history, std::size_t index)
      : pair_(&pair), geometry_(std::move(geometry)), history_(std::move(history)), index_(index) {}

  int dimension() const { return pair_->dimension(); }
  const Pair& pair() const { return *pair_; }
  const std::shared_ptr<const PairGeometry>& geometry() const { return geometry_; }
  const PairHistory& history() const { return history_->pairs[index_]; }
  const std::vector<SlaveNode>& slave_nodes() const { return pair_->slave_nodes(); }
  const Map& local_nodes() const { return *geometry_->pattern->local_nodes; }
  const std::vector<LocalOrdinal>& coupled_nodes(std::size_t s) const { return geometry_->pattern->coupled[s]; }
  const std::vector<LocalOrdinal>& loaded_nodes(std::size_t s) const { return geometry_->pattern->loaded[s]; }
  const std::vector<NodeRow>& rows() const { return *geometry_->rows; }
  const NodeRow& row(std::size_t s) const { return rows()[s]; }
  /// Couplings of facets with derivatives; empty when the geometry is frozen.
  const std::vector<FacetCoupling>& couplings() const { return geometry_->couplings; }
  const MultiplierTies& ties() const { return *geometry_->ties; }
  /// c_jm at the coupled node c, D_jj at j itself.
  double coefficient(std::size_t s, std::size_t c) const {
    return row(s).coefficients[c] + (coupled_nodes(s)[c] == slave_nodes()[s].local_node ? row(s).D : 0.0);
  }

  /// The force of a multiplier z of slave node s is  c_m z' - p dg/dx_m  at the node m. Where normal forces are the gaps' derivatives,
  /// z' = z - (z . n) n and p = z . n. Else z' = z and p = 0.
  SpatialVector coupled_part(std::size_t s, const SpatialVector& z) const {
    return pair_->has_forces_of_gaps() ? SpatialVector(z - z.dot(row(s).normal) * row(s).normal) : z;
  }
  double gap_pressure(std::size_t s, const SpatialVector& z) const { return pair_->has_forces_of_gaps() ? z.dot(row(s).normal) : 0.0; }
  /// The sum of that force over the slave side.
  SpatialVector resultant(std::size_t s, const SpatialVector& z) const;

  /// Clearance that is added to the gap at slave node s, as a mean.
  double clearance(std::size_t s) const { return history().clearances.empty() ? 0.0 : history().clearances[s]; }
  /// The mean gap at the start of the step where conditions are on the gap's rate; else 0.
  double gap_at_start(std::size_t s) const { return history().start_gaps.empty() ? 0.0 : history().start_gaps[s]; }
  /// False in a step with conditions on the gap's rate that began with node s open.
  bool may_close(std::size_t s) const { return gap_at_start(s) <= touching * pair_->size(); }
  /// What conditions add to the mean gap.
  double offset(std::size_t s) const { return clearance(s) - gap_at_start(s); }
  /// g of slave node s as conditions see it, beyond the overlap that is allowed: g_j + c_j sum_k D_jk.
  double own_gap(std::size_t s) const {
    return geometry_->gaps[s] + offset(s) * row(s).covered + history().allowed_overlap * slave_nodes()[s].weight;
  }
  /// [slave nodes] PairHistory::start_gaps of a step that starts here.
  std::vector<double> mean_gaps() const;
  /// That and n . q.
  double gap(std::size_t s, const NodeMultiplier& multiplier) const;
  /// u - (T q - T^old q^old); 0 without friction.
  TangentVector slip(std::size_t s, const NodeMultiplier& multiplier) const;
  /// The weighted gap that slave node s had to where it bears pressure when the step began; 0 if it was covered. Friction only.
  double start_gap(std::size_t s) const;
  /// Of a closed node whose conditions are exact the slip that these see: that since first contact.
  TangentVector slip_in_contact(std::size_t s, const NodeMultiplier& multiplier) const;
  /// The frame of slave node s. Tangents of partly fixed nodes are the fixed directions first.
  Frame frame(std::size_t s) const { return make_frame(row(s).normal, history().axes[s]); }
  bool covered(std::size_t s) const { return pair_->covered(s, row(s)); }
  /// Closed: covered, and the enforcement takes it to be closed.
  bool closed(std::size_t s, const NodeMultiplier& multiplier) const;
  /// That to where a node bears pressure, which may be deeper than where the surfaces touch.
  double gap_to_onset(std::size_t s) const { return own_gap(s) + std::max(0.0, pair_->enforcement().onset()) * row(s).covered; }
  /// z_n above which a covered node without history is closed: c_n g, g that to where it bears pressure.
  double closing_pressure(std::size_t s) const { return constant(s) * gap_to_onset(s); }
  /// The complementarity constant of the node in this step [traction / weighted gap].
  double constant(std::size_t s) const { return pair_->complementarity_constant(s) * history().constant_share; }
  /// True if the multiplier of node s is eliminated by its conditions and not by its momentum. The enforcement may ask for that. It is also so for
  /// a tied node of which so little is covered, D_jj < (1 - w) A_j, that its tie is the larger pivot.
  bool is_eliminated_by_law(std::size_t s) const {
    return !pair_->enforcement().needs_diagonal_coupling() || row(s).D * pair_->size() < ties().compliance(s) * pair_->definition().youngs_modulus;
  }
  /// A slave node as the law of friction sees it. Friction only.
  FrictionPoint friction_point(std::size_t s, double pressure) const;
  /// Slipped in all accepted steps and in this one [length]. Friction only.
  double slip_path(std::size_t s, ContactState state) const;

  /// C and its linearisation, of the law that the node obeys.
  /// @param missing_bound  gets what the law of friction says where it has no bound; C is NaN there
  Complementarity complementarity(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound = nullptr) const;
  /// Derivative of C of node s, whose linearisation is `law`, in entry dim c + i of its coupled nodes, at fixed z and q.
  SpatialVector constraint_gradient(const Complementarity& law, std::size_t s, std::size_t entry, const NodeMultiplier& multiplier) const;
  /// Derivative of C of node s with respect to q_j: C sees g + n . q and u - (T q - T^old q^old).
  SpatialMatrix shift_factor(const Complementarity& law, std::size_t s) const;

  /// Of pairs with updates, as a force over A_j: how far z of node s is from what its conditions give.
  double mismatch(std::size_t s, const NodeMultiplier& multiplier) const;
  /// Mismatch with lambda = z, with which an update and the next solve begin: eps g / w of a closed node, eps u / w of one that sticks. Less
  /// than `resolution` in gap or slip [length] is none.
  double change_of_update(std::size_t s, const NodeMultiplier& multiplier, double resolution) const;
  /// |z_j| w / A_j.
  double traction(std::size_t s, const NodeMultiplier& multiplier) const;
  /// The largest of mismatch() that a gap or slip of `resolution` [length] makes.
  double mismatch_of(double resolution) const;
  /// Start of conditions that take over the multiplier z of node s, where they start from multipliers.
  NodeStart start_from(std::size_t s, const SpatialVector& z) const;
  /// Sets the stiffening that follows from the cover.
  void set_stiffness(std::size_t s, NodeStart& start) const;

  /// References of later slips from this state on. Friction only.
  /// @param multipliers  [slave nodes]
  /// @param states       [slave nodes]
  /// @param paths        [slave nodes]
  /// @param start        [owned nodes x dim] positions of this state
  std::shared_ptr<const SlipReferences> slip_references(const std::vector<NodeMultiplier>& multipliers, const std::vector<ContactState>& states,
                                                        std::vector<double> paths, const RCP<const MultiVector>& start) const;
  /// [slave nodes] the facet nearest to the master by the mean gap; empty where none is covered.
  std::vector<SurfaceFacet> nearest_facets() const;
  /// Reference axes of the tangents for the next step: nodes whose normal has come near theirs get another one.
  std::vector<int> choose_axes() const;

 private:
  /// Of a node that is covered.
  ContactNode node(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound = nullptr) const;
  ContactNode unloaded_node(std::size_t s) const { return node(s, SpatialVector(SpatialVector::Zero(dimension()))); }
  /// Along how many of its tangents, the first ones, the displacement of node s is prescribed.
  Eigen::Index held_tangents(std::size_t s) const;
  /// Distance of z from the return map from lambda; in all of |z - z'|.
  double distance_to_return_map(const ContactNode& node) const;
  /// C and its linearisation at fixed q.
  Complementarity law_of(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const;

  const Pair* pair_;
  std::shared_ptr<const PairGeometry> geometry_;
  ContactHistory history_;
  std::size_t index_;
};

/// Error of the multipliers that follows from `change`, the largest change_of_update() over all ranks, and those of earlier rounds and steps. None:
/// not known yet.
std::optional<double> error_of_multipliers(const Settling& settling, double change, int round);
/// From then on updates shall converge as fast as those of a body as stiff as its facets; before the multipliers are updated.
Settling settled(const Settling& settling, double change, int round);

}  // namespace mortise::detail
