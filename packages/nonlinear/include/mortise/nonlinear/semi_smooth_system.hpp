#pragma once
// The system F(x) = 0, x = (d, z), and its semi-smooth Newton step, without NOX types.

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mortise/contact/contact_system.hpp"
#include "mortise/core/nodal_field.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/affine_constraints.hpp"
#include "mortise/nonlinear/contact_contribution.hpp"
#include "mortise/nonlinear/contribution.hpp"
#include "mortise/nonlinear/drive.hpp"
#include "mortise/nonlinear/held_motions.hpp"
#include "mortise/nonlinear/linear_solver.hpp"
#include "mortise/nonlinear/system_evaluation.hpp"
#include "mortise/nonlinear/system_linearisation.hpp"

namespace mortise {

/// A field whose unknowns stand among the dofs of a system.
struct SystemField {
  NodalField unknowns;  ///< its rows
  double size = 1.0;    ///< reference of deviations and increments of it: of displacements the size of the model
};

/// Parts of a nonlinear system. Shared by all groups that NOX clones.
struct SystemParts {
  RCP<const Map> dofs;                                       ///< owned
  RCP<const Map> local_dofs;                                 ///< owned then ghosts
  std::function<RCP<const Graph>()> bulk_graph;              ///< makes it: rows `dofs`; what the contributions' Jacobians write into
  std::function<long()> bulk_version;                        ///< another number for another bulk_graph(); empty: it stays. Read with contact alone
  std::vector<std::shared_ptr<Contribution>> contributions;  ///< f_int - f_ext, as their sum
  std::shared_ptr<const AffineConstraints> constraints;      ///< null: none; dependent rows may depend on those of `rigid`
  std::shared_ptr<RigidConstraints> rigid;                   ///< null: none
  /// Puts what inclined supports bear of forces on all dofs into `gathered`, at the dofs of the nodes that they hold. Collective; empty: there are
  /// none.
  std::function<void(const Vector& forces, Vector& gathered)> put_support_forces;
  std::shared_ptr<ContactSystem> contact;                                    ///< null: no contact
  std::vector<std::shared_ptr<ContactContribution>> contact_contributions;   ///< with contact alone; its further fields are those that they write
  std::shared_ptr<LinearSolver> linear_solver;                               ///< of each Newton step
  std::function<NearNullSpace(const Vector& displacement)> near_null_space;  ///< at a displacement, for multigrid alone
  /// For an x at which the Jacobian is singular although the system has a solution: a better point to linearise at, or null where there is none. It
  /// is close to x: Newton's step from there counts as the step from x. Collective; empty: never.
  std::function<RCP<Vector>(const SystemEvaluation& at)> better_start;
  /// The motions that a Newton step from there leaves out. Nothing: none. Collective; empty: never any.
  std::function<std::optional<HeldMotions>(const SystemEvaluation& at)> held_motions;
  std::shared_ptr<const TimeIntegration> time;  ///< null: statics, no contribution has time derivatives
  double length = 1.0;                          ///< size of the model
  /// All fields if there is more than one: then norms are taken of each. The first, in whose units norms are given, has the size `length`.
  std::vector<SystemField> fields;
};

/// F, J and the Newton step of x = (d, z). Its results are values: functions of x, time and history. The stiffness scale s of a
/// field's Dirichlet rows is the mean |diagonal| of the first stiffness that is assembled, and stays. Collective in all members but the accessors and
/// views.
class SemiSmoothSystem {
 public:
  /// Makes the map of x; the rest is made as it is needed. Collective.
  /// @throws std::invalid_argument for contributions that know fields or time derivatives which the system has not, and dofs of no field
  SemiSmoothSystem(SystemParts parts, Timers timers);

  /// The parts it was made of.
  const SystemParts& parts() const;
  /// Map of x: owned dofs, then owned multipliers.
  const RCP<const Map>& map() const;
  /// A view into the unknowns of x but the multipliers, which shares its memory.
  RCP<const Vector> unknowns(const Vector& x) const;
  /// A view into the unknowns of x but the multipliers, to write to.
  RCP<Vector> unknowns(Vector& x) const;
  /// A view into the multipliers of x, which shares its memory.
  RCP<const Vector> multipliers(const Vector& x) const;
  /// A view into the multipliers of x, to write to.
  RCP<Vector> multipliers(Vector& x) const;
  /// s of a field, of the first one a stiffness; 0 before the first evaluation.
  double stiffness_scale(std::size_t field = 0) const;
  /// A vector on the dofs with 0 for all fields but the first; with one field a view of the vector itself.
  RCP<const Vector> first_field(const Vector& of_dofs) const;
  /// The largest displacement of x, or value of another field as if its size were that of the first.
  double largest_unknown(const Vector& x) const;

  /// A state in which nothing has happened yet: no node is closed, slips are measured from x on. Throws StepFailure on every rank.
  AcceptedState initial_state(const Vector& x, double time = 0.0) const;
  /// The same with rates. Those of followers follow from those of what they follow; those of prescribed dofs are taken as they are.
  /// @param velocity  on the owned dofs
  /// @param at_rest   whether accelerations are 0 at the start; else inertia is in balance with all other forces but those of contact
  /// @throws StepFailure on every rank, std::logic_error in a system without time derivatives
  AcceptedState initial_state(const Vector& x, const Vector& velocity, bool at_rest, double time = 0.0) const;
  /// What holds within a step that starts from a state, without a guess of multipliers.
  StepContext step_from(const AcceptedState& state, double time) const;
  /// Context of a step, or of another try of it, that starts at displacement d from a state. Multipliers z get their guesses
  /// (ContactSystem::start_step()). Throws StepFailure on every rank.
  StepContext start_step(const AcceptedState& state, double time, const Vector& d, Vector& z) const;

  /// The step with complementarity constants times `share` (ContactSystem::weigh_gaps()).
  StepContext weigh_gaps(StepContext context, double share) const;

  /// F(x) = (r, C). Dirichlet rows hold s (d - prescribed), rows of followers s (d - what they follow). Forces on followers are in the rows of what
  /// they follow. Throws StepFailure on every rank, and std::invalid_argument for a context without a history where there is contact.
  SystemEvaluation evaluate(const Vector& x, const StepContext& context, StiffnessIs stiffness = StiffnessIs::not_known_to_be_needed) const;
  /// Evaluates at the displacement of an accepted state, with multipliers z: internal forces that are known are taken.
  SystemEvaluation evaluate_at(const AcceptedState& state, const Vector& z, const StepContext& context) const;
  /// The same displacement with other multipliers: what is known of an evaluation is taken.
  SystemEvaluation with_multipliers(const SystemEvaluation& evaluation, const Vector& z) const;
  /// The same x with another StepContext::field: what is known of an evaluation is taken.
  SystemEvaluation solving_for(const SystemEvaluation& evaluation, std::optional<std::size_t> field) const;
  /// max |d - prescribed| of x at a time, relative to the size of the field; costs next to nothing.
  double prescribed_deviation(const Vector& x, double time) const;
  /// Changes of loads and prescribed displacements between two pseudo-times at x. Throws StepFailure on every rank.
  Drive drive(const Vector& x, double from, double to) const;
  /// Multipliers follow what is covered since the iterate that was linearised last (ContactEvaluation::follow_cover()). Nothing if none changes.
  std::optional<SystemEvaluation> follow_cover(const SystemEvaluation& evaluation) const;

  /// J there. Throws StepFailure on every rank.
  SystemLinearisation linearise(const SystemEvaluation& evaluation) const;

  /// After a Newton solve that ended there: the same x with updated augmented Lagrange multipliers, from which it has to be solved again. Nothing if
  /// they are as exact as their pairs ask for. `round` counts from 1 within a step.
  /// @throws StepFailure(augmentation) on every rank if there were too many
  std::optional<SystemEvaluation> augment(const SystemEvaluation& evaluation, int round) const;

  /// The step that ended there is accepted: hands it to the contributions. The evaluation stays what it was.
  AcceptedState commit(const SystemEvaluation& evaluation) const;

  /// Stores an accepted state, with the histories of the contributions, which have to be those that it left.
  void store(StateArchive& archive, const AcceptedState& state) const;
  /// The state that was stored, by any number of ranks. Contributions take up their histories. Throws StepFailure on every rank.
  AcceptedState restore(StateArchive& archive) const;

 private:
  std::shared_ptr<const detail::SystemModel> model_;
};

}  // namespace mortise
