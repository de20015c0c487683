#pragma once
// One pair at one configuration: the facets' couplings summed to one row per owned slave node.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/complementarity.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/contact/regularised.hpp"
#include "multiplier_ties.hpp"

namespace mortise::detail {

/// Distance over h up to which nodes of a body that only contact holds count as about to close.
constexpr double near = 0.1;

/// Derivatives of one scalar of a slave node with respect to the positions of its coupled nodes; entry dim c + i is component i of node c.
using PositionGradient = std::vector<double>;

/// A slave node's share of the contact residual. Row j of D and M is kept as coefficients c_jm of "f_c += c_jm z_j at node m":
/// c_jj = D_jj, c_jk = D_jk, c_jl = -M_jl.
struct NodeRow {
  double D = 0.0;        ///< D_jj
  double covered = 0.0;  ///< sum_k D_jk = sum_l M_jl
  double gap = 0.0;      ///< weighted gap g_j
  SpatialVector normal;
  std::vector<double> coefficients;                                                   ///< [coupled nodes] c_jm, 0 at j itself
  PositionGradient dgap;                                                              ///< empty without derivatives
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3> dnormal;  ///< [dim x dim coupled nodes]; empty without derivatives
  TangentVector slip;  ///< weighted slip u_j since the start of the step; 0 without friction
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2>
      dslip;                  ///< [tangents x dim coupled nodes]; empty without derivatives or friction
  PositionGradient dcovered;  ///< regularised pairs only
};

/// The multiplier of a slave node as its conditions see it.
struct NodeMultiplier {
  SpatialVector z;
  SpatialVector shift;  ///< q_j of MultiplierTies; empty: 0
  double tie = 0.0;     ///< sigma_j

  NodeMultiplier(SpatialVector own) : z(std::move(own)) {}  // NOLINT(google-explicit-constructor): one without ties
};

/// What a slip is measured against: the couplings of a slave node in an accepted state.
struct SlipReference {
  std::vector<GlobalOrdinal> nodes;  ///< nodes it was coupled to, itself among them; empty: none, so that it slips freely in this step
  std::vector<double> coefficients;  ///< [nodes] c_jm
  TangentVector position;            ///< tau_a . sum_m c_jm x_m; frozen geometry only
  TangentVector tie;                 ///< tau_a . q, what its tie shifted the slip by; empty: open, or not tied
  double path = 0.0;                 ///< slipped until then [length]
};

/// What a slave node with friction remembers.
struct SlipHistory {
  SlipReference start, accepted;     ///< of the state that the step started from, of the last accepted one
  std::vector<LocalOrdinal> places;  ///< [start.nodes] among the coupled nodes of the current pattern
};

/// What the conditions of a regularised node start from: fixed while they are solved, renewed by an update of the multipliers and by a step.
struct RegularisedStart {
  SpatialVector multiplier;  ///< normal, along tau_a; nothing normal with penalty, no shear traction without friction
  double stiffening = 1.0;   ///< factor of eps; of augmented Lagrange, so that a mean gap falls by as much in an update whatever is covered
};

/// What updates of the multipliers have shown of the bodies. Augmented Lagrange.
struct Settling {
  double hardening = 1.0;       ///< factor of eps of all nodes: how much stiffer than facets the bodies are
  std::optional<double> ratio;  ///< their stiffness against the slowest of the changes, over eps; none: not known yet
};

/// A pair, its interface and what was last evaluated.
class PairCoupling {
 public:
  PairCoupling(RCP<const Map> owned_nodes, RCP<const MultiVector> reference, RCP<const MultiVector> fixed, const InterfaceMeasure& measure,
               ContactPair pair);

  /// 2 or 3.
  int dimension() const { return dimension_; }
  /// Searches at the positions x [owned nodes x dim]. Returns whether the pattern changed, the same on every rank.
  bool search(const MultiVector& x);
  /// Evaluates at x, the positions of the last search().
  void evaluate(const MultiVector& x, bool derivatives, std::optional<StepFailure>& failure);

  /// Takes the couplings and ties of the last evaluate(), at an accepted state, as those that later slips are measured against. Friction only.
  /// @param multipliers  [slave nodes]
  /// @param states       [slave nodes]
  void take_slip_reference(const std::vector<NodeMultiplier>& multipliers, const std::vector<ContactState>& states);
  /// The state of the last evaluate() is accepted: what is covered now, and how near, decides about adapt_surface() and newly_covered() in the next
  /// step.
  void accept_cover();
  /// What is covered now is no new cover any more.
  void mark_cover();
  /// Kinks are split as the accepted state, with positions x, tells. Whether that changed anything, and so the pattern; the same on every rank.
  /// Couplings have to be evaluated again.
  bool adapt_surface(const MultiVector& x);
  /// A step starts from the accepted state.
  void start_step();
  /// Regularised pairs: what multipliers start from in the next step. `z` gives those of slave node s.
  template <class Multiplier>
  void accept_multipliers(const Multiplier& z) {
    for (std::size_t s = 0; s < accepted_start_.size(); ++s) accepted_start_[s] = start_from(s, z(s));
    accepted_settling_ = settling_;
  }
  /// Adds the slip of an accepted state to the path. Friction only; take_slip_reference() follows.
  void accept_slip(std::size_t s, ContactState state);

  const ContactPair& definition() const { return pair_; }
  const Formulation& formulation() const { return *pair_.options.formulation.options; }
  const std::optional<Regularisation>& regularisation() const { return regularisation_; }
  /// Whether normal forces are the gaps' derivatives; then rows() hold these after each evaluate().
  bool variational() const { return formulation().coupling() == Coupling::variational_mortar; }
  /// Null: the pair has no friction.
  const FrictionLaw* friction() const { return friction_; }
  const std::vector<SlipHistory>& slip_histories() const { return slip_; }
  long slip_evaluations() const { return slip_evaluations_; }
  const MortarInterface& interface() const { return *interface_; }
  /// Which rule acts at kinks of the slave surface: averaged where the geometry is frozen.
  CornerRule corner_rule() const;
  /// From the owned nodes to interface().local_nodes().
  const Import& import() const { return *import_; }
  const std::vector<SlaveNode>& slave_nodes() const { return interface_->slave_nodes(); }
  const std::vector<NodeRow>& rows() const { return rows_; }
  /// Couplings of facets with derivatives; empty when the geometry is frozen.
  const std::vector<FacetCoupling>& couplings() const { return couplings_; }

  /// Whether the multiplier of slave node s is condensed before those of corners, whose momentum rows it stands in: that of a mid-side node.
  bool before_corners(std::size_t s) const { return slave_nodes()[s].middle && formulation().elimination() == Elimination::momentum; }

  /// The force of a multiplier z of slave node s is  c_m z' - p dg/dx_m  at the node m. With variational mortar z' = z - (z . n) n and p = z . n.
  /// Else z' = z and p = 0.
  SpatialVector coupled_part(std::size_t s, const SpatialVector& z) const {
    return variational() ? SpatialVector(z - z.dot(rows_[s].normal) * rows_[s].normal) : z;
  }
  double gap_pressure(std::size_t s, const SpatialVector& z) const { return variational() ? z.dot(rows_[s].normal) : 0.0; }
  /// The sum of that force over the slave side.
  SpatialVector resultant(std::size_t s, const SpatialVector& z) const;
  /// Variational mortar: second derivatives of sum_j z_n,j g_j at the last evaluate(). None of frozen geometry.
  std::vector<GapCurvature> gap_curvatures(const std::vector<double>& pressures) const;

  /// Element size h of the scaling and of the start rule.
  double size() const { return size_; }
  /// The part of an overlap that conditions do not see from now on.
  void allow_overlap(double depth) { overlap_ = depth; }
  /// g of slave node s at the last evaluate(), beyond the overlap that is allowed.
  double own_gap(std::size_t s) const { return rows_[s].gap + overlap_ * slave_nodes()[s].weight; }
  /// That and n . q; u - (T q - T^old q^old).
  double gap(std::size_t s, const NodeMultiplier& multiplier) const;
  TangentVector slip(std::size_t s, const NodeMultiplier& multiplier) const;
  /// c_n of slave node s: unless given E / (h A_j), of regularised conditions a tenth of that.
  double complementarity_constant(std::size_t s) const;
  /// Whether node s has a multiplier and its function anything to act on: D_jj > 0, of standard multipliers sum_k D_jk. What is
  /// round-off of a facet that is not covered is no part of it: see FacetMoments.
  bool covered(std::size_t s) const;
  /// Closed: covered and z_n - c_n (g + n . q) > 0, or what a regularised condition has in its place.
  bool closed(std::size_t s, const NodeMultiplier& multiplier) const;
  /// Of hardly covered nodes; none of penalty.
  const MultiplierTies& ties() const { return ties_; }
  /// Whether node s was not covered when that was last marked, or accepted since: then its multiplier says nothing yet.
  bool is_newly_covered(std::size_t s) const { return covered(s) && !marked_covered_.empty() && !marked_covered_[s]; }
  /// Whether hardly covered nodes are tied.
  bool has_ties() const { return pair_.options.full_cover > 0.0 && (!regularisation_ || regularisation_->augmentations > 0); }
  /// Whether the multiplier of node s is eliminated by its conditions and not by its momentum. So are those of regularised conditions, and that of a
  /// tied node of which so little is covered, D_jj < (1 - w) A_j, that its tie is the larger pivot.
  bool is_eliminated_by_law(std::size_t s) const {
    return formulation().elimination() == Elimination::law || rows_[s].D * size_ < ties_.compliance(s) * pair_.youngs_modulus;
  }
  /// z_n above which a covered node without history is closed: c_n g.
  double closing_pressure(std::size_t s) const;
  /// The frame of slave node s. Tangents of partly fixed nodes are the fixed directions first.
  Frame frame(std::size_t s) const { return make_frame(rows_[s].normal, axes_[s]); }
  /// An accepted state may give nodes whose normal has come near it another reference axis of the tangents. Friction only.
  void choose_axes();
  /// Augmented Lagrange, as a force over A_j: how far z of node s is from what its conditions give.
  double mismatch(std::size_t s, const NodeMultiplier& multiplier) const;
  /// The same with lambda = z, what an update and the next solve begin with: eps g / w of a closed node, eps u / w of one that sticks. Less than
  /// `resolution` in gap or slip [length] is none.
  double change_of_update(std::size_t s, const NodeMultiplier& multiplier, double resolution) const;
  /// |z_j| w / A_j.
  double traction(std::size_t s, const NodeMultiplier& multiplier) const;
  /// The largest of mismatch() that a gap or slip of `resolution` [length] makes.
  double mismatch_of(double resolution) const;
  /// What `change`, the largest change_of_update() over all ranks, and those of earlier rounds and steps say of the error of the multipliers. None:
  /// nothing yet.
  std::optional<double> error_of_multipliers(double change, int round) const;
  /// From now on updates shall converge as fast as those of a body as stiff as its facets; before the multipliers are updated.
  void settle_stiffness(double change, int round);
  /// The multipliers become those of z.
  void augment(std::size_t s, const SpatialVector& z) { start_[s] = start_from(s, z); }
  /// C and its linearisation, of the law that the node obeys. A node with a fixed component carries no shear traction.
  /// @param missing_bound  gets what the law of friction says where it has no bound; C is NaN there
  Complementarity complementarity(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound = nullptr) const;
  /// Derivative of C of node s, whose linearisation is `law`, in entry dim c + i of its coupled nodes, at fixed z and q.
  SpatialVector constraint_gradient(const Complementarity& law, std::size_t s, std::size_t entry, const NodeMultiplier& multiplier) const;
  /// Derivative of C of node s with respect to q_j: C sees g + n . q and u - (T q - T^old q^old).
  SpatialMatrix shift_factor(const Complementarity& law, std::size_t s) const;

 private:
  void refuse_constant_out_of_range() const;
  bool uses_reference() const { return pair_.options.geometry == ContactGeometry::reference; }
  void find_nearest_facets();
  /// Of a regularised node that is covered.
  RegularisedNode regularised_node(std::size_t s) const;
  /// Whether node s bears shear traction, if it is closed.
  bool rubs(std::size_t s) const;
  /// How far z is from the return map from lambda; in all of |z - z'|.
  double distance_to_return_map(std::size_t s, const NodeMultiplier& multiplier, const RegularisedNode& node) const;
  /// C and its linearisation at fixed q.
  Complementarity law_of(std::size_t s, const NodeMultiplier& multiplier, std::optional<Diagnostic>* missing_bound) const;
  void follow_pattern();
  void sum_to_rows(bool derivatives);
  void freeze();
  void evaluate_frozen(const MultiVector& x);
  void place_slip_histories();
  void measure_slip(bool derivatives);
  void measure_frozen_slip();
  void measure_covered();
  /// What the cover of the last evaluate() says of stiffening. Augmented Lagrange.
  void set_stiffness(std::size_t s, RegularisedStart& start) const;
  /// From z at the couplings of the last evaluate().
  RegularisedStart start_from(std::size_t s, const SpatialVector& z) const;

  ContactPair pair_;
  RCP<const Map> owned_nodes_;
  RCP<const MultiVector> reference_;
  std::unique_ptr<MortarInterface> interface_;
  MultiplierTies ties_;
  RCP<const Import> import_;
  RCP<MultiVector> local_positions_;
  std::vector<FacetCoupling> couplings_;
  std::vector<NodalNormal> normals_;
  std::vector<NodeRow> rows_;
  std::vector<SpatialVector> openings_;  ///< of slave nodes, variational mortar only: derivative of the gap by a translation of the master
  std::vector<char> accepted_covered_;   ///< [slave nodes] in the accepted state; empty before the first
  std::vector<char> marked_covered_;     ///< [slave nodes] when last marked
  std::vector<Facet<LocalOrdinal>>
      nearest_accepted_;  ///< [slave nodes] facet of the node nearest to the master; empty but with the rule `nearest facet`
  const FrictionLaw* friction_ = nullptr;
  std::vector<SlipHistory> slip_;  ///< [slave nodes]; empty without friction
  std::optional<Regularisation> regularisation_;
  std::vector<RegularisedStart> accepted_start_, start_;  ///< [slave nodes]; empty unless regularised
  Settling accepted_settling_, settling_;
  double last_change_ = 0.0;  ///< of the round before, at the present stiffness
  std::vector<int> axes_;     ///< [slave nodes] reference axis of the tangents; -1: none chosen yet
  long slip_evaluations_ = 0;
  std::vector<double> frozen_gap_;
  std::vector<LocalOrdinal> position_in_row_;
  double size_ = 1.0;
  double overlap_ = 0.0;  ///< allowed
  int dimension_ = 2;
  bool frozen_ = false;
};

}  // namespace mortise::detail
