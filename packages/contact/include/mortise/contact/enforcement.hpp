#pragma once
// Enforcements: how contact conditions are held at the slave nodes of a pair. A new one stands in enforcement/.

#include <optional>

#include "mortise/contact/complementarity.hpp"

namespace mortise {

struct Diagnostic;
struct FrictionLaw;

/// Start of the conditions of a node where Enforcement::starts_from_multipliers(): fixed while they are solved, renewed by an update of the
/// multipliers and by a step.
struct NodeStart {
  SpatialVector multiplier;  ///< normal, along tau_a: Enforcement::start_from()
  double stiffening = 1.0;   ///< factor of eps: Enforcement::stiffening()
};

/// The law of friction at one slave node.
struct NodeFriction {
  const FrictionLaw* law = nullptr;                    ///< of the pair
  FrictionPoint at_start;                              ///< at the start of the step, without pressure
  std::optional<Diagnostic>* missing_bound = nullptr;  ///< gets what the law says where it has no bound; null: nobody asks
  /// rho at a pressure.
  FrictionBound operator()(double pressure) const;
};

/// A slave node that is covered, as its conditions see it.
struct ContactNode {
  SpatialVector z;                                          ///< its multiplier
  SpatialVector normal;                                     ///< n
  int axis = -1;                                            ///< reference axis of the tangents; not used in 2D
  double gap = 0.0;                                         ///< weighted, beyond the overlap that is allowed; of a tied node with its tie's part
  TangentVector slip;                                       ///< weighted, since the start of the step; 0 without friction
  double start_gap = 0.0;                                   ///< g0 >= 0, weighted, that it closed in this step, to where it bears pressure
  double weight = 0.0;                                      ///< w = sum_k D_jk, its share of the surface that is covered
  double full_weight = 0.0;                                 ///< A_j, where it is covered wholly
  double constant = 0.0;                                    ///< c_n and c_t [traction / weighted gap]
  double youngs_modulus = 0.0;                              ///< E of the pair
  double size = 0.0;                                        ///< h of the pair
  double tie = 0.0;                                         ///< sigma_j, the compliance of its tie; 0: it is not tied
  std::optional<NodeFriction> friction;                     ///< none: it bears no shear traction
  HeldTangents held;                                        ///< tangents with a prescribed displacement; friction only
  const NodeStart* start = nullptr;                         ///< null unless Enforcement::starts_from_multipliers()
  double hardening = 1.0;                                   ///< Settling::hardening
  Frame frame() const { return make_frame(normal, axis); }  ///< (n, tau_a)
};

/// When multipliers are updated after a Newton solve.
struct MultiplierUpdates {
  double tolerance = 0.0;  ///< error of the multipliers that is accepted, over the largest one of the pair
  int most = 0;            ///< updates within a step
};

/// Enforcement of contact conditions: the law of a node, how its multiplier leaves the linear system, and what follows a Newton solve. Immutable, and
/// free of what one pair or node has of its own. By default a law that gives z as a function of gap and slip, without a memory.
class Enforcement {
 public:
  virtual ~Enforcement() = default;

  /// C of a node and its linearisation.
  virtual Complementarity law(const ContactNode& node) const = 0;
  /// True if the law closes the node.
  virtual bool is_closed(const ContactNode& node) const { return law(node).state != ContactState::open; }

  /// True if multipliers stay unknowns of the linear system: a saddle point system.
  virtual bool keeps_multipliers() const { return false; }
  /// True if multipliers leave it by the momentum rows of their slave nodes, which takes a diagonal D. Without this and the former they leave it by
  /// their own laws, where C_z has to be regular.
  virtual bool needs_diagonal_coupling() const { return false; }

  /// True if closed nodes have no gap and sticking ones no slip, whatever they bear.
  virtual bool holds_exactly() const { return false; }
  /// True if the law depends on ContactNode::weight, so that its derivatives are needed.
  virtual bool depends_on_weight() const { return true; }
  /// True if multipliers of hardly covered nodes are tied to those of their neighbours.
  virtual bool takes_ties() const { return false; }
  /// c_n A_j over E / h where the pair gives none: the stiffness of what a node hangs on. A contact zone that gives way as a whole, or yields, is ten
  /// times softer than a facet.
  virtual double relative_constant() const { return 0.1; }

  /// Mean overclosure -g / w up to which a node bears no traction [length]. Below 0 nodes act on one another before they touch, which has to be
  /// within the search reach.
  virtual double onset() const { return 0.0; }

  /// True if nodes remember multipliers of an accepted state or of an update: ContactNode::start.
  virtual bool starts_from_multipliers() const { return false; }
  /// The part of a multiplier that they remember.
  /// @param traction  (z_n, z_tau) in the node's frame; no z_tau without friction
  virtual SpatialVector start_from(const SpatialVector& traction) const { return traction; }
  /// NodeStart::stiffening of a node: factor of eps, so that a mean gap falls by as much in an update whatever is covered.
  virtual double stiffening(const ContactNode& /*node*/) const { return 1.0; }

  /// When multipliers are updated after a Newton solve. None: what it ends with is the solution. Otherwise return_map() and stiffness() are there.
  virtual std::optional<MultiplierUpdates> updates() const { return std::nullopt; }
  /// (z_n, z_tau) that the conditions make of ContactNode::start.
  virtual SpatialVector return_map(const ContactNode& node) const;
  /// Largest change of that for a change of the mean gap or slip [traction / length].
  virtual double stiffness(const ContactNode& node) const;
};

}  // namespace mortise
