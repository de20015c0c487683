#pragma once
// All contact pairs of a model: their residuals, their blocks of the linearised system, the condensation of the multipliers.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/complementarity.hpp"
#include "mortise/contact/decoupling.hpp"
#include "mortise/contact/formulation/dual_mortar.hpp"
#include "mortise/contact/friction.hpp"
#include "mortise/core/error.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/core/types.hpp"
#include "mortise/mortar/mortar_interface.hpp"

namespace mortise {

/// Which configuration carries the contact geometry.
enum class ContactGeometry { current, reference };

/// Options of one pair that do not depend on the mesh.
struct ContactOptions {
  MortarOptions mortar;                                 ///< of the integrals
  ContactGeometry geometry = ContactGeometry::current;  ///< reference: for small displacements
  double full_cover = 1.0;                              ///< c_0: a slave node of which less is covered is tied to its neighbours; 0: none is
  std::optional<double> complementarity_constant;       ///< c_n A_j, and c_t A_j; default E / h, of regularised conditions a tenth of that
  Choice<Formulation> formulation{"dual mortar", std::make_shared<DualMortar>(), {}};  ///< null is refused
  Choice<FrictionLaw> friction{"none", std::make_shared<NoFriction>(), {}};            ///< null is refused
  void describe(Parameters& parameters);                                               ///< the list of a pair
};

/// One pair as the host application gives it.
struct ContactPair {
  std::string name;  ///< as messages say it
  Place place;       ///< where the scene gives it; may be empty
  /// As MortarInterface wants them: every slave facet on each rank that owns a node of it, every master facet on one rank. Oriented as
  /// surface_facet.hpp says, with their normals out of the bodies. In 2D the body is on the left of the way along the nodes. In 3D a facet's nodes go
  /// round anticlockwise as seen from outside. Facets turned inside out are not found out: they never touch.
  SurfaceFacets slave;
  SurfaceFacets master;  ///< likewise
  /// Above 0. Of the softer side: sets c_n, the start rule and the stiffness of regularised conditions.
  double youngs_modulus = 0.0;
  ContactOptions options;                     ///< the rest of it
  std::optional<std::size_t> second_pass_of;  ///< an earlier pair of a two-pass formulation, with the sides exchanged
};

/// Norms and counts after an evaluation, over all ranks.
struct ContactNorms {
  double gap = 0.0;  ///< max |g_j| / (A_j h) over closed nodes; 0 of regularised pairs
  double complementarity =
      0.0;                 ///< max |C| relative to max |z| (with a floor), without C_n of closed nodes that are not regularised: that is the gap
  double force = 0.0;      ///< |f_c|
  double violation = 0.0;  ///< |A_j C_j| over all nodes [force]
  int active = 0;          ///< closed nodes
  int sticking = 0;        ///< of them
  int changed = 0;         ///< nodes whose state is not that last marked or, after start_step(), accepted
};

/// What can be known of an owned slave node after a solve.
struct ContactNodeState {
  GlobalOrdinal node = 0;                   ///< of the model
  LocalOrdinal owned_node = 0;              ///< local index in the map of owned nodes
  std::array<double, 3> traction{};         ///< multiplier z (compression positive along the normal), force per area; third component 0 in 2D
  std::array<double, 3> normal{};           ///< unit normal n of the slave
  double pressure = 0.0;                    ///< z . n
  double gap = 0.0;                         ///< weighted gap / A_j
  double weight = 0.0;                      ///< A_j
  bool closed = false;                      ///< its state is not open
  ContactState state = ContactState::open;  ///< what it does
  double covered = 0.0;                     ///< sum_k D_jk: the force on the slave side is -covered * traction
  double shear = 0.0;                       ///< z . tau, tau = n turned by +90 degrees; in 3D |z - (z . n) n|
  double shear_bound = 0.0;                 ///< rho, of closed nodes; friction only
  double slip = 0.0;                        ///< along tau, in 3D its size, since the start of the step [length]; friction only
  double slip_path = 0.0;                   ///< |slip| summed over the accepted steps [length]; friction only
  std::array<double, 3>
      force{};  ///< the force of this node's multiplier on the slave side is -force: sum_k D_jk z_j, with variational mortar that of the gap
};

/// How the integrals of a pair, of both passes if there are two, are spread over the ranks, in the last evaluation.
struct IntegrationLoad {
  long facets = 0;                  ///< slave facets that overlap a master facet, over all ranks
  long segments = 0;                ///< their overlaps
  double imbalance = 1.0;           ///< largest over mean number of segments of a rank
  double imbalance_as_owned = 1.0;  ///< the same at the last search, had every facet stayed with an owner of its nodes
  int redistributions = 0;          ///< searches that gave facets to other ranks
};

/// Kinks of a pair's slave surfaces, and what gives them their normals.
struct CornerReport {
  long kinks = 0;                          ///< over all ranks
  CornerRule rule = CornerRule::averaged;  ///< the one that acts
  bool as_asked = true;                    ///< the rule is the pair's option; false: something else of the pair calls for this one
};

/// How far an augmented Lagrange update was from being needed no more, over all ranks.
struct Augmentation {
  bool more = false;       ///< the multipliers were updated: solve again
  bool exhausted = false;  ///< more would be needed than the pair allows
  double error = 0.0;   ///< of the multipliers of the pair that is furthest from exact ones, over its largest; infinite where nothing is known of it
  double change = 0.0;  ///< what one more update would change of them, over the same
  double tolerance = 0.0;  ///< of `error`
  std::string pair;        ///< where
};

/// A direction in which a closed slave node holds bodies to one another, as what a traction along it does to each of them. Rigid motions that do no
/// work against any of these forces are not held by contact.
struct HoldingRow {
  /// On the nodes of one body, over the largest coefficient c_jm of the slave node: no unit. In 2D the moment has its third component alone.
  struct Wrench {
    int body = 0;                    ///< its number, as `places` of holding_rows() says it
    std::array<double, 3> force{};   ///< sum of the forces
    std::array<double, 3> moment{};  ///< about the point of the body that `places` refers to
  };
  std::size_t pair = 0;        ///< its contact pair
  bool along_surface = false;  ///< a tangent of a node that sticks; else the normal
  std::vector<Wrench> bodies;  ///< all that the node touches
};

/// A closed slave node that slips against friction: the shear traction rho y / |y| at y = z_tau + c_t u.
struct SlidingNode {
  std::size_t pair = 0;         ///< its contact pair
  LocalOrdinal multiplier = 0;  ///< local index of the first component of its z
  Frame frame;                  ///< its normal and tangents
  double bound = 0.0;           ///< rho, above 0
  double stiffness = 0.0;       ///< c_t
  double weight = 0.0;          ///< sum_k D_jk: u / weight is a length
  TangentVector slip;           ///< weighted slip u of the step
  /// [tangents] What a unit traction along tau_a does to each body: forces are areas. A rigid motion changes u_a by its work on them.
  std::vector<std::vector<HoldingRow::Wrench>> along;
};

struct BearingNode;

/// All pairs. z holds `dimension` components for each owned slave node that may carry a multiplier.
/// Displacements are given on the owned dofs. Collective in all members but the accessors.
class ContactSystem {
 public:
  /// @param dofs       owned dofs (dimension * node + component) of `owned_nodes`
  /// @param reference  [owned nodes x dim] reference positions
  /// @param fixed      [owned nodes x dim] 1 where prescribed, 2 where it follows a rigid body or a reference point, else 0
  /// @throws InputError (at the pair's name if it has no place) for
  ///   - a pair without Young's modulus, formulation or law of friction;
  ///   - a slave node in two pairs;
  ///   - a node that is slave in one pair and master in another where its multiplier is eliminated;
  ///   - what MortarInterface refuses.
  /// @throws std::invalid_argument for `dofs` that are not make_dof_map(*owned_nodes, dim), and vectors on other nodes
  ContactSystem(RCP<const Map> owned_nodes, RCP<const Map> dofs, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                const InterfaceMeasure& measure, std::vector<ContactPair> pairs, const Timers& timers);
  ~ContactSystem();

  std::size_t pairs() const;                             ///< how many there are, second passes included
  const std::string& pair_name(std::size_t pair) const;  ///< of ContactPair::name
  /// The pair that is the second pass of this one.
  std::optional<std::size_t> second_pass(std::size_t pair) const;
  /// Which configuration carries the geometry of a pair: the one in which its multipliers are pressures.
  ContactGeometry geometry(std::size_t pair) const;
  /// Whether multipliers stay unknowns of the linear system: then saddle_point_blocks() takes the place of condense() and recover().
  bool keeps_multipliers() const;
  /// By how much the surfaces of a pair may lie in one another, 0 unless said: what is left of an overlap that is taken up bit by bit. Conditions of
  /// the pair see gaps g_j + depth A_j from now on; node_states() tells those that there are.
  void allow_overlap(std::size_t pair, double depth);
  /// Map of z: ids lie above all dof ids.
  const RCP<const Map>& multiplier_map() const;

  /// Integrals at displacement d (kept until the next call); searches where needed. Slips are those since the last start_step(): before the first
  /// there are none. Local failures go to `failure`, which comes in empty (throw_if_any() tells all ranks). They are those of MortarInterface, and
  /// lost contact: a node went through the master surface so far that nothing is within reach any more. Such a node was closed in the accepted state
  /// or when last marked, or open and in front of the master in the accepted state. A node that opened or ran off the master's edge is not lost.
  void evaluate(const Vector& d, bool derivatives, std::optional<StepFailure>& failure);

  /// Graph of the condensed system: the bulk's and what the pairs couple. `changed` is set if it differs from the one of the last call: only then is
  /// `bulk` asked for the bulk's, which is not kept.
  RCP<const Graph> system_graph(const std::function<RCP<const Graph>()>& bulk, bool& changed);

  /// r += f_c(d, z) on the owned dofs, d of the last evaluate.
  void add_contact_force(const Vector& z, Vector& r) const;
  /// The parts of z across the normals of the last evaluate, of pairs with friction; 0 elsewhere.
  RCP<Vector> shear_tractions(const Vector& z) const;
  /// C(d, z), d of the last evaluate; rows in units of traction. NaN where a law of friction has no bound.
  void complementarity(const Vector& z, Vector& C) const;
  /// Puts what the law of friction says at a node of this rank where it has no bound into `failure`, if that is empty (kind input).
  void find_friction_failure(const Vector& z, std::optional<StepFailure>& failure) const;
  /// Norms and counts at z, d of the last evaluate. Collective.
  ContactNorms norms(const Vector& z) const;
  /// A_j for every component of each multiplier.
  RCP<Vector> weights() const;

  /// Takes the states at z, d of the last evaluate, as those that `changed` counts against, and what is covered: once for each Newton iterate.
  void mark_states(const Vector& z);
  /// Multipliers of nodes that the last evaluate finds not covered become 0. Those of nodes that came to be covered since the last mark_states(),
  /// start_step() or accept_states() take the mean that they are tied to, if that keeps them closed. Only pairs with ties. True if any did.
  /// Collective.
  bool follow_cover(Vector& z) const;
  /// Takes the states at z, d of the last evaluate, as those of the accepted state that the next step starts from; slip paths grow.
  void accept_states(const Vector& z);

  /// Updates the multipliers of augmented Lagrange pairs if those of any of them are not exact to its tolerance yet. For use after a Newton solve
  /// that ended in d, z of the last evaluate. `round` counts from 1 within a step. Collective.
  Augmentation augment(const Vector& z, int round);

  /// K += C~ = d(f_c)/dd at fixed z. `system` has system_graph() as asked for after the last evaluate(d, true), and is being filled.
  /// @throws std::logic_error where that, or start_step(), was left out
  void add_stiffness(const Vector& z, Matrix& system);

  /// Turns `system` (K~, in rows of prescribed dofs too) and `rhs` (-r without f_c) into the condensed system; keeps what recover() needs. Rows of
  /// prescribed dofs may be replaced afterwards, not before.
  /// @throws std::logic_error as add_stiffness(), and where keeps_multipliers()
  void condense(const Vector& z, Matrix& system, Vector& rhs);
  /// z^{k+1} from the whole displacement increment, with that of prescribed dofs.
  void recover(const Vector& increment, Vector& z_new) const;

  /// Whether, at the last condense(), hardly covered nodes that are in contact have multipliers that depend on one another's. Of these condense()
  /// takes each node's own alone. It leaves the rest of the linearised conditions out, L(dd, dz) of apply_left_out(). The step of the condensed
  /// system then is not Newton's; it is that of  J~ = J - L. The same on every rank.
  bool leaves_out_couplings() const;
  /// y = L(dd, dz) at the last condense(): rows of C.
  void apply_left_out(const Vector& dd, const Vector& dz, Vector& y) const;
  /// The right-hand side of the system of the last condense() for J~ (dd, dz) = -(r, C) with any r and C: `rhs` holds -r and is turned into it. Then
  /// recover() gives dz.
  void condense_right_hand_side(const Vector& C, Vector& rhs);

  /// What multigrid needs to know of the system that was condensed last, at z, d of the last evaluate.
  Decoupling decoupling(const Vector& z) const;

  /// The blocks of the saddle point form at the last evaluate(d, true): f_c = B(d) z, C_d, C_z on the maps of d and z. B and C_d hold zeros, so that
  /// their patterns change only with the candidates.
  struct SaddlePointBlocks {
    RCP<Matrix> B;    ///< [dofs x multipliers]
    RCP<Matrix> C_d;  ///< [multipliers x dofs]
    RCP<Matrix> C_z;  ///< [multipliers x multipliers]
  };
  /// Rebuilt at each call. Collective.
  SaddlePointBlocks saddle_point_blocks(const Vector& z) const;

  /// Goes back to the accepted states, and start rule: multipliers of nodes that touch, and seeds for bodies that only contact holds, are set to a
  /// small pressure. Only the guess z is changed.
  /// Slips are measured from the accepted state on; before any is accepted, from d on.
  /// @param unconstrained  for each owned node whether it belongs to a body that nothing but contact holds
  void start_step(const Vector& d, const std::vector<char>& unconstrained, Vector& z);

  /// At the last evaluate(). Collective.
  CornerReport corners(std::size_t pair) const;
  /// States of the owned slave nodes of a pair.
  std::vector<ContactNodeState> node_states(std::size_t pair, const Vector& z) const;
  /// Directions in which the owned slave nodes of all pairs hold, at z, d of the last evaluate(d, true). They are the normal of each closed node, and
  /// where it sticks the tangents along which it may bear shear. Collective.
  /// @param places  [owned nodes x 1 + dim] the body that a node counts for, below 0: none. The other columns are its position, in any unit, relative
  ///                to the point of the body that moments are taken about
  std::vector<HoldingRow> holding_rows(const Vector& z, const MultiVector& places) const;
  /// Of the owned slave nodes of all pairs with friction that is not regularised, at z, d of the last evaluate(); those that bear shear freely,
  /// without a fixed component. `places` as above. Collective.
  std::vector<SlidingNode> sliding_nodes(const Vector& z, const MultiVector& places) const;
  /// Of the owned slave nodes of all pairs, at z, d of the last evaluate(d, true), those that are closed, or covered and near. Near are the nodes
  /// that start_step() closes for a body that only contact holds: within 0.1 h. `places` as above. Collective.
  std::vector<BearingNode> bearing_nodes(const Vector& z, const MultiVector& places) const;
  /// Collective.
  IntegrationLoad integration_load(std::size_t pair) const;
  /// Bytes that the slip histories of all pairs take, over all ranks; 0 without friction. Collective.
  long friction_bytes() const;
  /// How often slips were measured, over all pairs, on this rank; 0 without friction.
  long friction_evaluations() const;
  /// Resultant (over all ranks) of the contact forces on the slave side of a pair, of both passes if there are two.
  std::array<double, 3> resultant(std::size_t pair, const Vector& z) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mortise
