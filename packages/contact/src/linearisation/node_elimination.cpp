// The multipliers of a condensed system: their recovery, substitution in other rows, and the step of the whole system.

#include "mortise/contact/node_elimination.hpp"

#include <TpetraExt_MatrixMatrix.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>
#include <stdexcept>

#include "evaluation/arguments.hpp"
#include "linearisation/condensation.hpp"
#include "linearisation/left_out_couplings.hpp"
#include "mortise/core/trilinos_versions.hpp"

namespace mortise {
namespace {

// 0 in rows of what is prescribed: it does not move where only C differs.
void hold_prescribed(const detail::ContactModel& model, Vector& rhs) {
  const auto fixed = model.fixed->getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto rows = rhs.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t node = 0; node < fixed.extent(0); ++node)
    for (std::size_t i = 0; i < fixed.extent(1); ++i)
      if (const LocalOrdinal row = model.rows[fixed.extent(1) * node + i]; fixed(node, i) == 1.0 && row >= 0) rows(row, 0) = 0.0;
}

}  // namespace

RCP<Matrix> detail::Condensation::slopes() const {
  const auto dimension = static_cast<std::size_t>(model().dimension);
  const RCP<const Graph>& graph = scatter->graph();
  std::vector<std::size_t> sizes(local_id_count(*model().multipliers), 0);
  for (const EliminatedNode& node : nodes)
    for (std::size_t i = 0; i < dimension; ++i) sizes[static_cast<std::size_t>(node.multiplier) + i] = node.columns.size();
  const auto S = rcp(new Matrix(model().multipliers, graph->getColMap(), Teuchos::arrayViewFromVector(sizes)));
  for (const EliminatedNode& node : nodes)
    for (std::size_t i = 0; i < dimension; ++i)
      S->insertLocalValues(node.multiplier + static_cast<LocalOrdinal>(i), static_cast<LocalOrdinal>(node.columns.size()), node.S[i].data(),
                           node.columns.data());
  S->fillComplete(model().dofs, model().multipliers);
  return S;
}

NodeElimination NodeElimination::apply(Vector& rhs) const {
  detail::Arguments(condensation_->model(), "apply").on_dofs(rhs, "rhs").agree();
  const auto scope = condensation_->model().timers.scope("condensation");
  return {condensation_, condensation_->condense_right_hand_side(nullptr, rhs), condensation_->at().z};
}

NodeElimination NodeElimination::apply(Vector& rhs, const Vector& C) const {
  detail::Arguments(condensation_->model(), "apply").on_dofs(rhs, "rhs").on_multipliers(C, "C").agree();
  const auto scope = condensation_->model().timers.scope("condensation");
  return {condensation_, condensation_->condense_right_hand_side(&C, rhs), Teuchos::null};
}

void NodeElimination::recover(const Vector& dd, Vector& z) const {
  detail::Arguments(condensation_->model(), "recover").on_dofs(dd, "dd").on_multipliers(z, "z").agree();
  const auto scope = condensation_->model().timers.scope("condensation");
  const Graph& graph = *condensation_->scatter->graph();
  Vector on_columns(graph.getColMap());
  if (graph.getImporter().is_null())
    Tpetra::deep_copy(on_columns, dd);
  else
    on_columns.doImport(dd, *graph.getImporter(), Tpetra::REPLACE);
  const auto d = on_columns.getLocalViewHost(Tpetra::Access::ReadOnly);
  Tpetra::deep_copy(z, *b_);
  const auto to = z.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const detail::EliminatedNode& node : condensation_->nodes)
    for (int i = 0; i < condensation_->model().dimension; ++i) {
      double value = to(node.multiplier + i, 0);
      for (std::size_t k = 0; k < node.columns.size(); ++k) value += node.S[i][k] * d(node.columns[k], 0);
      to(node.multiplier + i, 0) = value;
    }
}

SubstitutedRows NodeElimination::substitute(const Matrix& G) const {
  if (!G.getDomainMap()->isSameAs(*condensation_->model().multipliers))
    throw std::logic_error(
        "contact: substitute() of rows whose columns are no multipliers: complete them with the map of multipliers as their domain");
  const auto scope = condensation_->model().timers.scope("condensation");
  SubstitutedRows result{rcp(new Matrix(G.getRowMap(), 0)), rcp(new Vector(G.getRangeMap()))};
  Tpetra::MatrixMatrix::Multiply(G, false, *condensation_->slopes(), false, *result.of_dofs);
  G.apply(*b_, *result.constant);
  return result;
}

void NodeElimination::solve(const Vector& right, const Solve& solve, Vector& dd, Vector& dz, const Matrix* further, double tolerance) const {
  detail::Arguments(condensation_->model(), "solve").on_dofs(right, "right").on_dofs(dd, "dd").on_multipliers(dz, "dz").agree();
  solve(right, dd);
  complete(solve, dd, dz, further, tolerance);
}

// The step of J = J~ + L from that of J~: see left_out_couplings.hpp. With J~ (dd, dz) = -(0, C) what is prescribed does not move, and multipliers of
// open nodes do not change.
void NodeElimination::complete(const Solve& solve, Vector& dd, Vector& dz, const Matrix* further, double tolerance) const {
  const detail::ContactModel& model = condensation_->model();
  const detail::TieBlocks& left_out = condensation_->left_out;
  recover(dd, dz);
  if (!z_.is_null()) dz.update(-1.0, *z_, 1.0);
  if (left_out.of_multipliers.is_null()) return;
  const auto scope = model.timers.scope("tied multipliers");
  const auto step_of = [&](const Vector& C, Vector& change_d, Vector& change_z) {
    Vector rhs(model.dofs);
    const NodeElimination elimination = apply(rhs, C);
    if (further != nullptr) further->apply(*elimination.b_, rhs, Teuchos::NO_TRANS, -1.0, 1.0);
    hold_prescribed(model, rhs);
    solve(rhs, change_d);
    elimination.recover(change_d, change_z);
  };
  const auto leave_out = [&](const Vector& change_d, const Vector& change_z, Vector& y) {
    const auto part = model.timers.scope("condensation");
    left_out.of_multipliers->apply(change_z, y);
    left_out.of_positions->apply(change_d, y, Teuchos::NO_TRANS, 1.0, 1.0);
  };
  detail::correct_step(*model.weights(), tolerance, step_of, leave_out, dd, dz);
}

}  // namespace mortise
