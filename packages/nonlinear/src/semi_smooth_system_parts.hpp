#pragma once
// What SemiSmoothSystem holds.

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "matrix_values.hpp"
#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "reduction.hpp"
#include "saddle_point_matrix.hpp"

namespace mortise {
namespace detail {
/// Ids of the first map, then those of the second.
RCP<const Map> map_of_both(const Map& dofs, const Map& multipliers);
}  // namespace detail

struct SemiSmoothSystem::Implementation {
  SystemParts parts;
  Timers timers;
  double time = 0.0;
  RCP<const Map> map, multipliers;
  Import to_local;
  std::vector<LocalOrdinal> fixed;  // prescribed dofs
  Vector internal, external, contact_force, local_displacement;
  double stiffness_scale = 0.0;  // s; 0: not known yet

  RCP<Matrix> matrix;         // K; a linear solve turns it into K + C~, condensed, its prescribed rows and columns eliminated
  bool is_stiffness = false;  // it is K, at the displacement of the last assembly
  std::unique_ptr<detail::DirichletElimination> elimination;
  bool graph_changed = true;  // since the linear solver saw it
  double tolerance = 0.0;     // of the linear solve under way

  std::unique_ptr<detail::Reduction> reduction;             // null: nothing follows
  std::unique_ptr<detail::SaddlePointMatrix> saddle_point;  // null: multipliers are eliminated
  RCP<const Graph> merged_graph;                            // of the last matrix that was reduced or holds multipliers

  RCP<Vector> internal_at;                          // displacement to which `internal` belongs; null: none
  std::optional<ContactHistory> accepted, history;  // of the accepted state, of the step; none: nothing has been evaluated yet
  std::map<std::size_t, double> allowed_overlaps;   // by pair, from the next start_step() on
  ContactStates last_states;                        // those that ResidualNorms::changed counts against
  std::optional<DifferentiatedContact> contact;     // at contact_at, with `history`
  std::optional<ContactLaws> laws;                  // of `contact`; none: of no z yet
  std::optional<ContactLaws> committed;             // of the state that was committed last, until the next step starts
  RCP<Vector> committed_at;                         // its x
  RCP<Vector> contact_at;                           // displacement of `contact`
  RCP<Vector> jacobian_at;                          // x of the last jacobian()

  Implementation(SystemParts given, Timers given_timers)
      : parts(std::move(given)),
        timers(std::move(given_timers)),
        to_local(parts.dofs, parts.local_dofs),
        internal(parts.dofs),
        external(parts.dofs),
        contact_force(parts.dofs),
        local_displacement(parts.local_dofs) {
    multipliers = rcp(new const Map(0, 0, parts.dofs->getComm()));
    map = parts.dofs;
    if (parts.contact) {
      multipliers = parts.contact->multiplier_map();
      map = detail::map_of_both(*parts.dofs, *multipliers);
    }
    if (parts.prescribed) fixed = parts.prescribed->dofs();
    if (parts.dependent) reduction = std::make_unique<detail::Reduction>(parts.dependent, parts.dofs, parts.local_dofs);
    if (parts.contact && parts.contact->keeps_multipliers())
      saddle_point = std::make_unique<detail::SaddlePointMatrix>(reduction ? reduction->unknowns() : parts.dofs, multipliers);
  }

  const Communicator& comm() const { return *parts.dofs->getComm(); }
  RCP<const Vector> d(const Vector& x) const { return x.offsetView(parts.dofs, 0); }
  RCP<const Vector> z(const Vector& x) const { return x.offsetView(multipliers, parts.dofs->getNodeNumElements()); }

  Configuration configuration(const Vector& displacement) {
    local_displacement.doImport(displacement, to_local, Tpetra::REPLACE);
    return {time, displacement, local_displacement};
  }

  // internal = f_int, external = -f_ext. Internal forces depend on no time: those of a displacement at hand are not evaluated again.
  void evaluate_bulk(const Vector& displacement) {
    const Configuration at = configuration(displacement);
    const bool is_at_hand = !internal_at.is_null() && detail::same_values(displacement, *internal_at);
    if (!is_at_hand) {
      internal_at = Teuchos::null;
      internal.putScalar(0.0);
    }
    external.putScalar(0.0);
    std::optional<StepFailure> failure;
    for (const auto& contribution : parts.contributions)
      if (contribution->kind() == Contribution::Kind::external)
        contribution->add_residual(at, external, failure);
      else if (!is_at_hand)
        contribution->add_residual(at, internal, failure);
    if (parts.dependent) parts.dependent->check(local_displacement, failure);
    throw_if_any(comm(), failure);
    if (!is_at_hand) internal_at = rcp(new Vector(displacement, Teuchos::Copy));
  }

  // r = f_int - f_ext + f_c on all dofs. The reduction is made for `displacement`.
  void sum_forces(const Vector& displacement, const Vector& z, Vector& r) {
    r.update(1.0, internal, 1.0, external, 0.0);
    if (parts.contact) {
      contact_force.putScalar(0.0);
      if (is_contact_at(displacement))
        contact->add_force(z, contact_force);
      else
        parts.contact->evaluate(displacement, *history).add_force(z, contact_force);
      r.update(1.0, contact_force, 1.0);
    }
    if (!reduction) return;
    configuration(displacement);
    reduction->update(local_displacement);
  }

  bool is_contact_at(const Vector& displacement) const { return contact && detail::same_values(displacement, *contact_at); }

  void have_history(const Vector& displacement) {
    if (history) return;
    accepted = history = parts.contact->initial_history(displacement);
    last_states = (*history)->states;
  }

  void take_history(const ContactHistory& next) {
    history = next;
    last_states = next->states;
    laws.reset();
    contact.reset();
  }

  void evaluate_contact(const Vector& displacement) {
    have_history(displacement);
    if (is_contact_at(displacement)) return;
    laws.reset();
    contact.reset();  // before there is another one: only one is held
    contact = parts.contact->differentiate(displacement, *history, &last_states);
    contact_at = rcp(new Vector(displacement, Teuchos::Copy));
  }

  const ContactLaws& laws_at(const Vector& displacement, const Vector& z) {
    evaluate_contact(displacement);
    if (!laws || !detail::same_values(z, laws->multipliers())) laws = contact->laws(z);
    return *laws;
  }

  // The linearised contact at the x of the last jacobian().
  ContactLinearisation linearised_contact() {
    const ContactLaws& at = laws_at(*d(*jacobian_at), *z(*jacobian_at));
    return contact->linearise(at);
  }

  // A matrix with the bulk's graph, or with the larger one that the current candidates of contact ask for.
  void match_graph() {
    const RCP<const Graph> graph = parts.contact       ? parts.contact->graph(*contact, parts.bulk_graph)
                                   : !matrix.is_null() ? matrix->getCrsGraph()
                                                       : parts.bulk_graph();
    const bool changed = matrix.is_null() || matrix->getCrsGraph() != graph;
    if (!changed) return;
    matrix = rcp(new Matrix(graph));
    matrix->fillComplete(parts.dofs, parts.dofs);
    is_stiffness = false;
    graph_changed = true;
    if (!reduction && !saddle_point) elimination = std::make_unique<detail::DirichletElimination>(*graph, fixed);
  }

  // The contact is evaluated at `displacement`.
  void assemble_bulk(const Vector& displacement) {
    const Configuration at = configuration(displacement);
    match_graph();
    is_stiffness = false;
    matrix->resumeFill();
    matrix->setAllToScalar(0.0);
    std::optional<StepFailure> failure;
    for (const auto& contribution : parts.contributions) contribution->add_jacobian(at, *matrix, failure);
    matrix->fillComplete(parts.dofs, parts.dofs);
    throw_if_any(comm(), failure);
    is_stiffness = true;
    if (stiffness_scale > 0.0) return;
    Vector diagonal(parts.dofs);
    matrix->getLocalDiagCopy(diagonal);
    const double mean = diagonal.norm1() / std::max<double>(1.0, static_cast<double>(diagonal.getGlobalLength()));
    stiffness_scale = mean > 0.0 && std::isfinite(mean) ? mean : 1.0;
  }

  // Opens the matrix, which is K, for what makes it something else.
  void open_matrix() {
    is_stiffness = false;
    matrix->resumeFill();
  }

  LinearSolveReport solve(const RCP<Matrix>& matrix, const std::vector<LocalOrdinal>& prescribed, const Vector& increment, Vector& rhs,
                          const MultigridInput& multigrid, Vector& x);
  LinearSolveReport solve_reduced(const RCP<Matrix>& matrix, const Vector& d, const Vector& r, const Vector& increment, Vector& rhs,
                                  const MultigridInput& multigrid, Vector& dd);
  LinearSolveReport solve_saddle_point(const Vector& d, const Vector& r, const Vector& C, const Vector& increment,
                                       GeometricContactStiffness geometric_stiffness, Vector& dd, Vector& dz);
  void solve_again(CondensedContact& condensed, const Vector& C, Vector& dd, Vector& dz, LinearSolveReport& report);
  void correct(CondensedContact& condensed, LinearSolveReport& report, Vector& dd, Vector& dz);
  void match_elimination(const RCP<const Graph>& graph, const std::vector<LocalOrdinal>& prescribed);

  void evaluate_at_jacobian() {
    if (jacobian_at.is_null()) throw std::logic_error("SemiSmoothSystem: jacobian() comes first");
    const auto displacement = d(*jacobian_at);
    if (parts.contact) evaluate_contact(*displacement);
    match_graph();
    if (!is_stiffness) assemble_bulk(*displacement);
  }
};

}  // namespace mortise
