#pragma once
// All contact pairs of a model: what does not change with the displacement, and what makes the values that do.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mortise/contact/contact_evaluation.hpp"
#include "mortise/contact/contact_history.hpp"
#include "mortise/contact/contact_linearisation.hpp"
#include "mortise/contact/contact_pair.hpp"
#include "mortise/contact/contact_report.hpp"
#include "mortise/core/nodal_field.hpp"
#include "mortise/core/state_archive.hpp"
#include "mortise/core/timers.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

namespace detail {
struct ContactModel;
}  // namespace detail

/// Outcome of an augmented Lagrange update, over all ranks: the error that is left of the multipliers.
struct Augmentation {
  bool more = false;       ///< the multipliers have to be updated: solve again with `history`
  bool exhausted = false;  ///< not exact, and more would be needed than the pair allows: undo the step; `more` is false then
  double error = 0.0;   ///< of the multipliers of the pair that is furthest from exact ones, over its largest; infinite where nothing is known of it
  double change = 0.0;  ///< their change by one more update, over the same largest one
  double tolerance = 0.0;                 ///< of `error`
  std::string pair;                       ///< where
  std::optional<ContactHistory> history;  ///< with the new multipliers; none unless `more`
};

/// Displacements of the owned nodes: from a vector on the dofs, and from the host's vector for prescribed components.
struct NodalDisplacement {
  /// Prescribed components do not move.
  NodalDisplacement(const Vector& of_dofs) : dofs(of_dofs) {}
  /// @param of_nodes  [owned nodes x dim], read where a component is prescribed
  NodalDisplacement(const Vector& of_dofs, const MultiVector& of_nodes) : dofs(of_dofs), nodes(&of_nodes) {}
  const Vector& dofs;                  ///< of the unknowns
  const MultiVector* nodes = nullptr;  ///< of the rest; null: it does not move
};

/// All pairs. z holds `dimension` components for each owned slave node that may carry a multiplier.
/// Displacements are given on the owned dofs. These may be any numbering that a host has, with other fields among them, and without the components
/// that it prescribes. Histories and evaluations depend on the arguments of a call alone, not on earlier calls. Collective in
/// all members but the accessors.
///
/// What a host hands over is checked. Vectors on other maps, and histories and states of another system, throw std::invalid_argument on every rank.
/// Values of another system throw std::logic_error, numbers of pairs that do not exist std::out_of_range.
class ContactSystem {
 public:
  /// @param displacement  which dofs the displacements of the owned nodes are
  /// @param dofs          owned rows of the host's system
  /// @param reference     [owned nodes x dim] reference positions
  /// @param fixed         [owned nodes x dim] 1 where prescribed, 2 where it follows a rigid body or a reference point, else 0; components without a
  ///                      dof are prescribed
  /// @param further       other fields of the host whose rows get what crosses the interface, as a temperature's: graph() has place in the rows of
  ///                      their components for what condensation brings to the rows of the displacement
  /// @throws InputError (at the pair's name if it has no place) for
  ///   - a pair without Young's modulus, formulation or law of friction;
  ///   - what MortarInterface refuses.
  /// @throws std::invalid_argument for ids that are not among `dofs`, components that are neither unknown nor prescribed, and vectors on other nodes
  ContactSystem(const NodalField& displacement, RCP<const Map> dofs, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                const InterfaceMeasure& measure, std::vector<ContactPair> pairs, const Timers& timers, std::vector<NodalField> further = {});
  /// A system with numbered_by_nodes(), whose map is make_dof_map(*owned_nodes, dim).
  ContactSystem(const RCP<const Map>& owned_nodes, RCP<const Map> dofs, RCP<const MultiVector> reference, RCP<const MultiVector> fixed,
                const InterfaceMeasure& measure, std::vector<ContactPair> pairs, const Timers& timers, std::vector<NodalField> further = {});

  int dimension() const;                                 ///< 2 or 3
  std::size_t pairs() const;                             ///< number of pairs, second passes included
  const std::string& pair_name(std::size_t pair) const;  ///< of ContactPair::name
  /// The pair that is the second pass of this one.
  std::optional<std::size_t> second_pass(std::size_t pair) const;
  /// Configuration that carries the geometry of a pair: the one in which its multipliers are pressures.
  ContactGeometry geometry(std::size_t pair) const;
  /// Ids of the slave nodes of a pair that this rank owns, in the order of ContactStates.
  std::vector<GlobalOrdinal> slave_ids(std::size_t pair) const;
  /// Slave facets of a pair on this rank, as they were given.
  const SurfaceFacets& slave_facets(std::size_t pair) const;
  /// True if multipliers stay unknowns of the linear system: then ContactLinearisation::saddle_point_blocks() takes the place of condense().
  bool keeps_multipliers() const;
  /// Map of z: ids lie above all dof ids.
  const RCP<const Map>& multiplier_map() const;
  /// A_j for every component of each multiplier.
  RCP<Vector> weights() const;

  /// The history of a model that starts at displacement d, before anything was accepted: no node is closed, slips are measured from d on.
  /// @throws StepFailure on every rank, as evaluate()
  ContactHistory initial_history(const NodalDisplacement& d) const;

  /// The integrals at displacement d. Slips are those since the state of `history`.
  /// @throws StepFailure on every rank for
  ///   - a position that is not finite, a facet without extent, a projection that has no solution;
  ///   - a node that has gone through the master and out of its reach (lost_contact): one that was closed in `history`, or stood in front of the
  ///   master.
  ContactEvaluation evaluate(const NodalDisplacement& d, const ContactHistory& history) const;
  /// Evaluates with derivatives.
  /// @param last  states at the last Newton iterate: nodes that were closed there must not be lost either. Null: none.
  DifferentiatedContact differentiate(const NodalDisplacement& d, const ContactHistory& history, const ContactStates* last = nullptr) const;

  /// Graph of the condensed system at an evaluation: the bulk's, and what the pairs couple. The same graph as long as the candidates of contact stay;
  /// only for another one `bulk` is asked for the bulk's, which is not kept.
  /// @param bulk_version  another number than before: `bulk` gives another graph
  RCP<const Graph> graph(const ContactEvaluation& evaluation, const std::function<RCP<const Graph>()>& bulk, long bulk_version = 0) const;

  /// The start of a step from displacement d: kinks of the slave surfaces are chosen as the accepted state tells. Then multipliers of nodes
  /// that touch are set to a small pressure. Only the guess z is changed. For a body with a load that nothing holds, guess_closed() closes more.
  /// @return the history that holds within the step
  /// @throws StepFailure on every rank, as evaluate()
  ContactHistory start_step(const ContactHistory& accepted, const NodalDisplacement& d, Vector& z) const;

  /// Lets the surfaces of a pair overlap by `depth` without pressure, 0 by default: the rest of an overlap that is taken up bit by bit. Conditions of
  /// the pair then see gaps g_j + depth A_j, which node_states() reports.
  ContactHistory allow_overlap(const ContactHistory& history, std::size_t pair, double depth) const;

  /// The history with complementarity constants times `share`, of conditions whose solution does not depend on them. A smaller one takes longer to
  /// close nodes, and does not close and open them in turn where a weighted gap is no measure of where a surface is.
  ContactHistory weigh_gaps(const ContactHistory& history, double share) const;

  /// The history with the clearances of all pairs at a time, those that hold within the step that ends then.
  /// @throws InputError on every rank where a clearance is not finite
  ContactHistory with_clearances(const ContactHistory& history, double time) const;

  /// The history with temperatures of a pair's slave nodes, those that friction sees within the step (FrictionLaw::reads_temperature()). A second
  /// pass is a pair of its own.
  /// @param temperatures  [slave_ids(pair)] means of both sides at the start of the step
  /// @throws std::invalid_argument for another number of them, std::out_of_range for a pair that does not exist
  ContactHistory with_temperatures(const ContactHistory& history, std::size_t pair, std::vector<double> temperatures) const;

  /// Updates the multipliers of augmented Lagrange pairs if those of any of them are not exact to its tolerance yet. `laws` are those of a Newton
  /// solve's end. `round` counts from 1 within a step.
  Augmentation augment(const ContactLaws& laws, int round) const;

  /// The history after a step that ended in the state of `laws`: the next step starts from there; slip paths grow.
  ContactHistory commit(const ContactLaws& laws) const;

  /// The history of another system with the same pairs, and the same nodes on the same ranks. Prescribed components and rows may differ, as in a host
  /// that releases a support. Nodes keep their multipliers, states and slipped paths; those that had no multiplier begin open. The
  /// multipliers of the result are on this system's map.
  /// @throws std::invalid_argument on every rank for other slave nodes; StepFailure on every rank, as evaluate()
  ContactHistory carry_over(const ContactSystem& before, const ContactHistory& accepted) const;

  /// Stores a history, by the ids of the nodes.
  void store(StateArchive& archive, const ContactHistory& history) const;
  /// The history that was stored, by any number of ranks, in a state with displacement d and multipliers z.
  /// @throws StepFailure on every rank, as evaluate()
  ContactHistory restore(StateArchive& archive, const NodalDisplacement& d, const Vector& z) const;

  /// Distribution of the integrals of a pair over the ranks in the last evaluation.
  IntegrationLoad integration_load(std::size_t pair) const;
  /// Number of slip measurements, over all pairs, on this rank; 0 without friction.
  long friction_evaluations() const;

 private:
  std::shared_ptr<const detail::ContactModel> model_;
};

/// Bytes that the slip histories of all pairs take, over all ranks; 0 without friction. Collective.
long friction_bytes(const ContactHistory& history);

}  // namespace mortise
