// The linear systems of a Newton step.

#include "left_out_couplings.hpp"
#include "semi_smooth_system_parts.hpp"

namespace mortise {

using detail::DirichletElimination;

// Solves matrix x = rhs, x = increment on the rows `prescribed`. The matrix is open for changes, rhs is overwritten.
LinearSolveReport SemiSmoothSystem::Implementation::solve(const RCP<Matrix>& matrix, const std::vector<LocalOrdinal>& prescribed,
                                                          const Vector& increment, Vector& rhs, const MultigridInput& multigrid, Vector& x) {
  elimination->impose(*matrix, increment, stiffness_scale, rhs);
  matrix->fillComplete(matrix->getRowMap(), matrix->getRowMap());
  parts.linear_solver->set_matrix(matrix, graph_changed, multigrid);
  graph_changed = false;
  Vector solution(matrix->getRowMap());
  const LinearSolveReport report = parts.linear_solver->solve(rhs, solution, tolerance);
  Tpetra::deep_copy(x, solution);
  const auto from = increment.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = x.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (const LocalOrdinal row : prescribed) to(row, 0) = from(row, 0);
  return report;
}

// Matrices that are formed anew for each solve have a new graph only when its entries differ.
void SemiSmoothSystem::Implementation::match_elimination(const RCP<const Graph>& graph, const std::vector<LocalOrdinal>& prescribed) {
  if (!merged_graph.is_null() && detail::same_entries(*graph, *merged_graph)) return;
  elimination = std::make_unique<DirichletElimination>(*graph, prescribed);
  merged_graph = graph;
  graph_changed = true;
}

// The same where displacements follow others: see Reduction. r is the whole residual, followers' forces not gathered.
LinearSolveReport SemiSmoothSystem::Implementation::solve_reduced(const RCP<Matrix>& matrix, const Vector& d, const Vector& r,
                                                                  const Vector& increment, Vector& rhs, const MultigridInput& multigrid, Vector& dd) {
  if (matrix->isFillActive()) matrix->fillComplete(parts.dofs, parts.dofs);
  Vector start(parts.dofs), force(parts.dofs);
  reduction->deviation(d, -1.0, start);
  matrix->apply(start, force);
  rhs.update(-1.0, force, 1.0);
  const RCP<Matrix> reduced = reduction->reduced(*matrix, r);
  const std::vector<LocalOrdinal> prescribed = reduction->places(fixed);
  match_elimination(reduced->getCrsGraph(), prescribed);
  reduced->resumeFill();
  const RCP<Vector> q_increment = reduction->unknown_part(increment), q_rhs = reduction->reduced(rhs);
  Vector dq(reduction->unknowns());
  MultigridInput of_unknowns;
  if (multigrid.near_null_space) of_unknowns.near_null_space = [&] { return reduction->reduced(multigrid.near_null_space()); };
  if (multigrid.decoupling) of_unknowns.decoupling = [&] { return reduction->reduced(multigrid.decoupling()); };
  const LinearSolveReport report = solve(reduced, prescribed, *q_increment, *q_rhs, of_unknowns, dq);
  dd.update(1.0, *reduction->expanded(dq), 1.0, start, 0.0);
  return report;
}

// Multipliers kept:
//   ( K + C~  B ) dd   -r
//   ( C_d   C_z ) dz = -C    with the rows of C as forces, A_j C.   With followers dd = T dq + d0 the first rows are multiplied by T^T.
LinearSolveReport SemiSmoothSystem::Implementation::solve_saddle_point(const Vector& d, const Vector& r, const Vector& C, const Vector& increment,
                                                                       GeometricContactStiffness geometric_stiffness, Vector& dd, Vector& dz) {
  open_matrix();
  const ContactLinearisation linearised = linearised_contact();
  if (geometric_stiffness == GeometricContactStiffness::included) linearised.add_stiffness(*matrix);
  matrix->fillComplete(parts.dofs, parts.dofs);
  const SaddlePointBlocks blocks = linearised.saddle_point_blocks();
  const RCP<const Vector> weights = parts.contact->weights();
  Vector rhs_d(r, Teuchos::Copy), rhs_z(C, Teuchos::Copy), start(parts.dofs);
  rhs_d.scale(-1.0);
  RCP<const Matrix> K = matrix, B = blocks.B, C_d = blocks.C_d;
  RCP<const Vector> q_rhs = rcp(&rhs_d, false), q_increment = rcp(&increment, false);
  std::vector<LocalOrdinal> prescribed = fixed;
  if (reduction) {
    reduction->deviation(d, -1.0, start);
    matrix->apply(start, rhs_d, Teuchos::NO_TRANS, -1.0, 1.0);
    blocks.C_d->apply(start, rhs_z, Teuchos::NO_TRANS, 1.0, 1.0);
    K = reduction->reduced(*matrix, r);
    B = reduction->reduced_rows(*blocks.B);
    C_d = reduction->reduced_columns(*blocks.C_d);
    prescribed = reduction->places(fixed);
    q_rhs = reduction->reduced(rhs_d);
    q_increment = reduction->unknown_part(increment);
  }
  rhs_z.elementWiseMultiply(-1.0, *weights, Vector(rhs_z, Teuchos::Copy), 0.0);
  const RCP<Matrix> merged = saddle_point->merged(*K, *B, *C_d, *blocks.C_z, *weights);
  match_elimination(merged->getCrsGraph(), prescribed);
  merged->resumeFill();
  const RCP<Vector> rhs = saddle_point->merged(*q_rhs, rhs_z), fixed_increment = saddle_point->merged(*q_increment, Vector(multipliers));
  Vector x(merged->getRowMap());
  const LinearSolveReport report = [&] {
    try {
      return solve(merged, prescribed, *fixed_increment, *rhs, {}, x);
    } catch (const StepFailure& failure) {  // on every rank
      bool two_passes = false;
      for (std::size_t pair = 0; pair < parts.contact->pairs(); ++pair) two_passes |= parts.contact->second_pass(pair).has_value();
      if (!two_passes) throw;
      throw StepFailure(failure.kind(), std::string(failure.what()) +
                                            "; two passes ask for contact at the nodes of both sides, which over-constrains surfaces that touch over "
                                            "more than a facet: take \"passes\" \"single\", or a mortar formulation");
    }
  }();
  Vector dq(K->getRowMap());
  saddle_point->split(x, dq, dz);
  if (reduction)
    dd.update(1.0, *reduction->expanded(dq), 1.0, start, 0.0);
  else
    Tpetra::deep_copy(dd, dq);
  return report;
}

// Solves J~ (dd, dz) = -(0, C) with the condensed system at hand and its prescribed rows eliminated. Displacements that are prescribed or follow
// others do not change, and neither do multipliers of open nodes.
void SemiSmoothSystem::Implementation::solve_again(CondensedContact& condensed, const Vector& C, Vector& dd, Vector& dz, LinearSolveReport& report) {
  Vector rhs(parts.dofs);
  condensed.condense_right_hand_side(C, rhs);
  const RCP<Vector> q_rhs = reduction ? reduction->reduced(rhs) : rcp(&rhs, false);
  {
    const auto view = q_rhs->getLocalViewHost(Tpetra::Access::ReadWrite);
    for (const LocalOrdinal row : reduction ? reduction->places(fixed) : fixed) view(row, 0) = 0.0;
  }
  Vector dq(q_rhs->getMap());
  report.iterations += parts.linear_solver->solve(*q_rhs, dq, tolerance).iterations;
  if (reduction)
    Tpetra::deep_copy(dd, *reduction->expanded(dq));
  else
    Tpetra::deep_copy(dd, dq);
  condensed.recover(dd, dz);
}

// From the step of J~ to that of J = J~ + L, see left_out_couplings.hpp.
void SemiSmoothSystem::Implementation::correct(CondensedContact& condensed, LinearSolveReport& report, Vector& dd, Vector& dz) {
  const auto scope = timers.scope("tied multipliers");
  const RCP<const Vector> weights = parts.contact->weights();
  detail::correct_step(
      *weights, std::max(tolerance, 1e-10),
      [&](const Vector& C, Vector& change_d, Vector& change_z) { solve_again(condensed, C, change_d, change_z, report); },
      [&](const Vector& change_d, const Vector& change_z, Vector& y) { condensed.apply_left_out(change_d, change_z, y); }, dd, dz);
}

// The free rows of J dx = -F condensed to (K~ condensed) dd = rhs, then reduced to the unknowns if some displacements follow others. The
// prescribed rows s dd = -s (d - prescribed) are solved at once, their columns go to the right-hand side; contact's recovery needs the whole dd.
// Where a formulation keeps its multipliers the whole system is solved as it is.
LinearSolveReport SemiSmoothSystem::newton_direction(const Vector& F, Vector& direction, double tolerance,
                                                     GeometricContactStiffness geometric_stiffness) {
  Implementation& self = *implementation_;
  self.tolerance = tolerance;
  self.evaluate_at_jacobian();
  const RCP<const Vector> residual = displacement(F), d = displacement(*self.jacobian_at), z = multipliers(*self.jacobian_at);
  const RCP<Vector> dd = displacement(direction);
  const SystemParts& parts = self.parts;
  Vector r(*residual, Teuchos::Copy);
  if (self.reduction) {  // F holds what is gathered from followers
    self.evaluate_bulk(*d);
    self.sum_forces(*d, *z, r);
  }
  Vector prescribed_increment(parts.dofs);
  {
    const auto step = prescribed_increment.getLocalViewHost(Tpetra::Access::ReadWrite);
    const auto rows = residual->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (const LocalOrdinal row : self.fixed) step(row, 0) = -rows(row, 0) / self.stiffness_scale;
  }
  if (self.saddle_point)
    return self.solve_saddle_point(*d, r, *multipliers(F), prescribed_increment, geometric_stiffness, *dd, *multipliers(direction));
  Vector rhs(r, Teuchos::Copy);
  rhs.scale(-1.0);

  const RCP<Matrix>& matrix = self.matrix;
  std::optional<CondensedContact> condensed;
  if (parts.contact) {  // -r without f_c
    self.contact_force.putScalar(0.0);
    const ContactLinearisation linearised = self.linearised_contact();
    self.contact->add_force(*z, self.contact_force);
    rhs.update(1.0, self.contact_force, 1.0);
    self.open_matrix();
    if (geometric_stiffness == GeometricContactStiffness::included) linearised.add_stiffness(*matrix);
    condensed = linearised.condense(*matrix, rhs);
  } else if (!self.reduction) {
    self.open_matrix();
  }

  MultigridInput multigrid;
  if (parts.near_null_space) multigrid.near_null_space = [&] { return parts.near_null_space(*d); };
  if (condensed) multigrid.decoupling = [&] { return condensed->decoupling(); };
  LinearSolveReport report = self.reduction ? self.solve_reduced(matrix, *d, r, prescribed_increment, rhs, multigrid, *dd)
                                            : self.solve(matrix, self.fixed, prescribed_increment, rhs, multigrid, *dd);
  if (!parts.contact) return report;
  const RCP<Vector> dz = multipliers(direction);
  Vector z_new(self.multipliers);
  condensed->recover(*dd, z_new);
  dz->update(1.0, z_new, -1.0, *z, 0.0);
  if (condensed->leaves_out_couplings()) self.correct(*condensed, report, *dd, *dz);
  return report;
}

}  // namespace mortise
