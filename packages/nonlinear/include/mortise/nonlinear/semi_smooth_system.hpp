#pragma once
// The system F(x) = 0, x = (d, z), and its semi-smooth Newton step, without NOX types.

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise {

/// Sizes of the residual's blocks at one iterate, over all ranks; what the status tests look at.
struct ResidualNorms {
  double momentum = 0.0;                  ///< |r| on free dofs relative to max(|f_int|, |f_ext|, |f_c|, 1e-6 s |d|), reactions included
  double momentum_absolute = 0.0;         ///< |r| on free dofs [force]
  double round_off = 0.0;                 ///< what round-off alone leaves of momentum_absolute
  double prescribed = 0.0;                ///< max |d - prescribed| and |d - what it follows|, relative to the size of the model
  double gap = 0.0;                       ///< ContactNorms::gap
  double complementarity = 0.0;           ///< ContactNorms::complementarity
  double merit = 0.0;                     ///< (|r|^2 + |s (d - prescribed)|^2 + sum_j |A_j C_j|^2)^1/2, a force; infinite if that is not finite
  int active = 0;                         ///< closed nodes
  int sticking = 0;                       ///< of them
  int changed = 0;                        ///< ContactNorms::changed
  std::array<long long, 2> active_set{};  ///< two hashes of the closed nodes and what they do, independent of the partition
  bool finite = true;                     ///< whether all of the residual is
};

/// What a nonlinear system is made of. Shared by all groups that NOX clones.
struct SystemParts {
  RCP<const Map> dofs;                                                       ///< owned
  RCP<const Map> local_dofs;                                                 ///< owned then ghosts
  std::function<RCP<const Graph>()> bulk_graph;                              ///< makes it: rows `dofs`; what the contributions' Jacobians write into
  std::vector<std::shared_ptr<Contribution>> contributions;                  ///< f_int - f_ext, as their sum
  std::shared_ptr<PrescribedDisplacements> prescribed;                       ///< never null; may have no dofs
  std::shared_ptr<DependentDisplacements> dependent;                         ///< null: every displacement is an unknown or prescribed
  std::shared_ptr<ContactSystem> contact;                                    ///< null: no contact
  std::shared_ptr<LinearSolver> linear_solver;                               ///< of each Newton step
  std::function<NearNullSpace(const Vector& displacement)> near_null_space;  ///< at a displacement; asked for by multigrid alone
  /// For an x at which the Jacobian is singular although the system has a solution: a better point to linearise at, or null where there is none. It
  /// is close to x as far as Newton's method is concerned. F is F(x), `contact` the laws at x. Collective; empty: never.
  std::function<RCP<Vector>(const Vector& x, const Vector& F, const ContactLaws& contact)> better_start;
  double length = 1.0;  ///< size of the model
};

/// Whether a direction knows how the forces of given multipliers change with the geometry of contact, d(f_c)/dd at fixed z.
enum class GeometricContactStiffness { included, left_out };

/// F, J and the Newton step of x = (d, z). Stateless but for buffers: everything is a function of x, time and committed history.
/// The stiffness scale s of the Dirichlet rows is the mean |diagonal| of the first stiffness that is assembled, and stays.
/// Collective in all members but the accessors and views.
class SemiSmoothSystem {
 public:
  /// Makes the map of x; the rest is made as it is needed. Collective.
  SemiSmoothSystem(SystemParts parts, Timers timers);
  ~SemiSmoothSystem();

  /// What it was made of.
  const SystemParts& parts() const;
  /// Map of x: owned dofs, then owned multipliers.
  const RCP<const Map>& map() const;
  /// A view into the displacements of x, which shares its memory.
  RCP<const Vector> displacement(const Vector& x) const;
  /// The same, to write to.
  RCP<Vector> displacement(Vector& x) const;
  /// A view into the multipliers of x, which shares its memory.
  RCP<const Vector> multipliers(const Vector& x) const;
  /// The same, to write to.
  RCP<Vector> multipliers(Vector& x) const;

  /// Pseudo-time at which everything is evaluated from now on.
  void set_time(double time);
  /// The one that is set.
  double time() const;
  /// s, a stiffness; 0 before the first residual.
  double stiffness_scale() const;

  /// F(x) = (r, C); Dirichlet rows hold s (d - prescribed), rows of followers s (d - what they follow), whose forces stand in the rows of what
  /// they follow. Throws StepFailure on every rank.
  void residual(const Vector& x, Vector& F, ResidualNorms& norms);
  /// max |d - prescribed| of x at the time that is set, relative to the size of the model; costs next to nothing. Collective.
  double prescribed_deviation(const Vector& x) const;
  /// The multipliers of x follow what is covered at its displacement (ContactSystem::follow_cover()), from the last jacobian() on. True if any
  /// changed.
  bool follow_cover(Vector& x);
  /// A step, or another try of it, starts at x from the accepted state: multipliers get their guesses (ContactSystem::start_step()). Nothing without
  /// contact. Throws StepFailure on every rank.
  /// @param unconstrained  for each owned node whether it belongs to a body that nothing but contact holds
  void start_step(Vector& x, const std::vector<char>& unconstrained);
  /// By how much the surfaces of a contact pair may lie in one another from the next start_step() on.
  void allow_overlap(std::size_t pair, double depth);
  /// The contact conditions at x: of a state that was committed, in the step that led there, until the next step starts. Else in the present step.
  /// With contact only. Throws StepFailure on every rank.
  ContactLaws contact_laws(const Vector& x);
  /// The history of the accepted state; none without contact, and before anything was evaluated.
  const std::optional<ContactHistory>& contact_history() const;
  /// Prepares J at x, and takes the states of the nodes at x as those that ResidualNorms::changed counts against.
  void jacobian(const Vector& x);
  /// x of the last jacobian(); null if there was none since set_time().
  RCP<const Vector> linearised_at() const;
  /// y = J v by the saddle point blocks, at the x of the last jacobian().
  void apply(const Vector& v, Vector& y) const;
  /// Newton direction: solves J dx = -F at the x of the last jacobian(). It does so by condensation or, where the contact keeps multipliers, as a
  /// saddle point system. F is F(x): a condensing contact forms the rows of C itself. `tolerance`: see LinearSolver::solve(). Without the geometric
  /// stiffness of contact it is not Newton's direction. Where contact's geometry does not change, it depends on the states of the nodes alone
  /// and not on their multipliers.
  /// @throws StepFailure (linear_solver) on every rank
  LinearSolveReport newton_direction(const Vector& F, Vector& direction, double tolerance = 0.0,
                                     GeometricContactStiffness geometric_stiffness = GeometricContactStiffness::included);

  /// After a Newton solve that ended in x: whether augmented Lagrange multipliers were updated, so that it has to be repeated. `round` counts from 1
  /// within a step. Throws StepFailure(augmentation) on every rank if there were too many.
  bool augment(const Vector& x, int round);

  /// f_int - f_ext + f_c on all owned dofs at x, without Dirichlet rows: on prescribed dofs these are the reactions, those of followers gathered.
  void forces(const Vector& x, Vector& r);

  /// The step that ended at x is accepted: hands it to the contributions.
  void commit(const Vector& x);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mortise
