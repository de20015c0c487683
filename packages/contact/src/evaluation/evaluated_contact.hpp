#pragma once
// Data behind the values of contact: the pairs, their evaluations, the conditions of their nodes.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "evaluation/system_scatter.hpp"
#include "mortise/contact/contact_system.hpp"
#include "mortise/core/nodal_field.hpp"
#include "pairs/pair_evaluation.hpp"

namespace mortise::detail {

struct EvaluatedContact;

/// The displacements of an interface's local nodes among the dofs of the host's system.
struct InterfaceDofs {
  std::shared_ptr<const InterfacePattern> pattern;
  std::vector<GlobalOrdinal> ids;                   ///< [dim nodes] NodalField::none: no unknown
  RCP<const Map> map;                               ///< of those that are unknowns
  RCP<const Export> to_owners;                      ///< from `map` to the dofs
  std::vector<LocalOrdinal> places;                 ///< [dim nodes] in `map`, -1: no unknown
  std::vector<std::vector<GlobalOrdinal>> further;  ///< [further fields][components nodes]
};

/// A row that condensation has replaced, with its values.
struct CondensedRow {
  const Matrix* system = nullptr;  ///< to be compared alone: it may be gone
  LocalOrdinal row = -1;           ///< -1: none on this rank
  std::vector<double> values;
};

/// All pairs, without anything that depends on a displacement; and the graph of the condensed system, kept as long as candidates stay.
struct ContactModel {
  explicit ContactModel(NodalField field) : displacement(std::move(field)), owned_nodes(displacement.nodes()) {}

  NodalField displacement;
  RCP<const Map> owned_nodes, dofs, multipliers;
  std::vector<LocalOrdinal> rows;   ///< [dim owned nodes] local indices in `dofs`, -1: no unknown
  std::vector<NodalField> further;  ///< fields beside the displacement whose rows get what crosses the interfaces
  RCP<const MultiVector> reference, fixed;
  Timers timers;
  int dimension = 2;
  double extent = 0.0;  ///< largest coordinate of the reference positions
  std::vector<std::unique_ptr<Pair>> pairs;
  std::vector<std::vector<LocalOrdinal>> multiplier_of;                      ///< [pair][slave node] local index of the first component in z, -1: none
  std::vector<char> leaves_out;                                              ///< [pair] a slave node carries no multiplier, on any rank
  std::vector<std::vector<LocalOrdinal>> master_nodes;                       ///< [pair] local indices in owned_nodes
  std::size_t layout = 0;                                                    ///< layout_of()
  bool middles_first = false;                                                ///< there are multipliers that are condensed before others, on any rank
  mutable std::shared_ptr<SystemScatter> scatter;                            ///< of the last evaluation that was asked for a graph; null: none yet
  mutable long bulk_version = 0;                                             ///< of the bulk's graph that it was built from
  mutable CondensedRow condensed_row;                                        ///< of the last condensation: to tell that it is done twice
  mutable std::vector<std::shared_ptr<const InterfaceDofs>> interface_dofs;  ///< [pairs] the last of dofs_of()

  const Communicator& comm() const { return *dofs->getComm(); }
  /// To which gaps and slips are known.
  double position_round_off() const { return 4.0 * std::numeric_limits<double>::epsilon() * extent; }
  /// The pair that is the second pass of this one.
  std::optional<std::size_t> second_pass(std::size_t pair) const;
  bool keeps_multipliers() const;
  /// Positions X + d on the owned nodes.
  RCP<const MultiVector> positions(const NodalDisplacement& d) const;
  /// The displacements of a pair's local nodes among the dofs. Collective.
  std::shared_ptr<const InterfaceDofs> dofs_of(std::size_t pair, const std::shared_ptr<const InterfacePattern>& pattern) const;
  /// z of slave node s of a pair (0 without multiplier), from a host view of z.
  template <class View>
  SpatialVector z_of(const View& z, std::size_t pair, std::size_t s) const {
    SpatialVector result = SpatialVector::Zero(dimension);
    if (const LocalOrdinal first = multiplier_of[pair][s]; first >= 0)
      for (int i = 0; i < dimension; ++i) result[i] = z(first + i, 0);
    return result;
  }
  /// z of the owned slave nodes of a pair [x dim], on the map of MultiplierTies::owned_nodes().
  template <class View>
  RCP<MultiVector> owned_multipliers(std::size_t pair, const View& z, const RCP<const Map>& map) const {
    const auto result = rcp(new MultiVector(map, static_cast<std::size_t>(dimension)));
    const auto view = result->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t s = 0; s < multiplier_of[pair].size(); ++s) {
      const SpatialVector zs = z_of(z, pair, s);
      for (int i = 0; i < dimension; ++i) view(s, i) = zs[i];
    }
    return result;
  }
  /// ContactSystem::weights().
  RCP<Vector> weights() const;
  /// Sums and largest values over ranks.
  double sum(double value) const;
  double maximum(double value) const;

  /// The pairs at positions x. Collective.
  /// @param history  without a state to measure from (no positions) nothing can be lost yet
  /// @param last     what the nodes did last; null: nothing is known
  /// @throws StepFailure on every rank
  std::shared_ptr<const EvaluatedContact> evaluate(const std::shared_ptr<const ContactModel>& self, const RCP<const MultiVector>& x,
                                                   const ContactHistory& history, const ContactStates* last, bool derivatives) const;
};

/// All pairs at one displacement, with one history.
struct EvaluatedContact {
  std::shared_ptr<const ContactModel> model;
  ContactHistory history;
  RCP<const MultiVector> positions;  ///< [owned nodes x dim]
  std::vector<PairEvaluation> pairs;
  std::vector<std::shared_ptr<const InterfaceDofs>> dofs;  ///< [pairs]

  /// Global id of a component of a local node's displacement, NodalField::none where it is no unknown.
  GlobalOrdinal id(std::size_t pair, LocalOrdinal node, int component) const {
    return dofs[pair]->ids[static_cast<std::size_t>(model->dimension * node + component)];
  }
  bool any_ties() const {
    return std::any_of(pairs.begin(), pairs.end(), [](const PairEvaluation& pair) { return pair.ties().any(); });
  }
  /// Multipliers of the owned slave nodes of a pair and what they are tied by. Collective where there are ties.
  std::vector<NodeMultiplier> multipliers_of(const Vector& z, std::size_t pair) const;
  /// The same integrals, seen with another history.
  std::shared_ptr<const EvaluatedContact> with(const ContactHistory& other) const;
  /// r += f_c(z).
  void add_force(const Vector& z, Vector& r) const;
};

/// The conditions of all nodes, [pair][slave node].
struct EvaluatedLaws {
  ContactEvaluation evaluation;
  std::shared_ptr<const EvaluatedContact> contact;  ///< the evaluation's
  RCP<const Vector> z;
  std::vector<std::vector<NodeMultiplier>> multipliers;
  std::vector<std::vector<Complementarity>> laws;  ///< open, with nothing in it, for nodes without multiplier

  ContactState state(std::size_t pair, std::size_t s) const { return laws[pair][s].state; }
};

/// A node that went through the master surface, out of its reach, at the evaluated displacement.
std::optional<StepFailure> find_lost_contact(const EvaluatedContact& contact, const ContactStates* last, bool failed);

/// `accepted` with the kinks that its state calls for, and what slips are measured against there. Collective. Throws StepFailure on every rank.
ContactHistory with_kinks_of_its_state(const std::shared_ptr<const ContactModel>& model, const ContactHistory& accepted);

/// Contributions of the ties of hardly covered nodes. Derivatives with respect to z [z x z] and to d [z x dofs].
struct TieBlocks {
  RCP<Matrix> of_multipliers, of_positions;
};
/// L of tied_conditions.cpp; null where no tied node is in contact. Collective.
TieBlocks tied_conditions(const EvaluatedLaws& laws);

}  // namespace mortise::detail
