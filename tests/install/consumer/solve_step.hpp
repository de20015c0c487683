#pragma once
// Part of a host application: Newton's method for one step, as docs/embedding.md shows it.

#include <Teuchos_CommHelpers.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "blocks.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/linear_solver.hpp"

namespace host {

constexpr double tolerance = 1e-11;

inline double sum_over_ranks(const Blocks& blocks, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*blocks.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

// Rows of prescribed dofs: s dd = s (prescribed - d). They are the application's, and replaced after condense().
inline void prescribe(const Blocks& blocks, const Vector& target, const Vector& d, Matrix& A, Vector& rhs) {
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(local_id_count(*blocks.dofs)); ++row) {
    const GlobalOrdinal id = blocks.dofs->getGlobalElement(row);
    if (!blocks.held(id / blocks.dimension)) continue;
    Matrix::local_inds_host_view_type columns;
    Matrix::values_host_view_type values;
    A.getLocalRowView(row, columns, values);
    std::vector<double> replaced(columns.extent(0), 0.0);
    for (std::size_t k = 0; k < replaced.size(); ++k)
      if (A.getColMap()->getGlobalElement(columns(k)) == id) replaced[k] = E;
    A.replaceLocalValues(row, Teuchos::ArrayView<const LocalOrdinal>(columns.data(), columns.extent(0)), Teuchos::arrayViewFromVector(replaced));
    rhs.replaceLocalValue(row, E * (target.getData()[row] - d.getData()[row]));
  }
}

// |r| of free dofs, and by how much prescribed dofs are off.
inline std::array<double, 2> residuals(const Blocks& blocks, const Vector& r, const Vector& target, const Vector& d) {
  double free = 0.0, off = 0.0;
  for (std::size_t row = 0; row < local_id_count(*blocks.dofs); ++row)
    if (blocks.held(blocks.dofs->getGlobalElement(static_cast<LocalOrdinal>(row)) / blocks.dimension))
      off += std::abs(target.getData()[row] - d.getData()[row]);
    else
      free += r.getData()[row] * r.getData()[row];
  return {std::sqrt(sum_over_ranks(blocks, free)), sum_over_ranks(blocks, off)};
}

/// Result of a Newton solve beside d and z.
struct Solved {
  bool converged = false;
  Vector r;                         ///< forces that are not balanced: the reactions of prescribed dofs
  std::optional<ContactLaws> laws;  ///< contact at d and z; none unless `converged`
  std::vector<double> residuals;    ///< at the iterates since the state of a node changed last
};

inline Solved solve_step(const Blocks& blocks, const ContactSystem& contact, const ContactHistory& accepted, const Matrix& K, LinearSolver& solver,
                         const Vector& target, Vector& d, Vector& z) {
  const ContactHistory history = contact.start_step(accepted, d, z);
  ContactStates last = history->states;
  RCP<Matrix> A;
  Solved solved{false, Vector(blocks.dofs), {}, {}};
  Vector internal(blocks.dofs), rhs(blocks.dofs), dd(blocks.dofs), dz(contact.multiplier_map());
  for (int iteration = 0; iteration < 30; ++iteration) {
    // A StepFailure comes on every rank: undo the step, take a smaller one.
    const DifferentiatedContact at = contact.differentiate(d, history, &last);
    const ContactLaws laws = at.laws(z);

    K.apply(d, internal);
    Tpetra::deep_copy(solved.r, internal);
    laws.add_force(solved.r);
    const ContactNorms norms = laws.norms(last);
    const auto [unbalanced, off] = residuals(blocks, solved.r, target, d);
    if (norms.changed > 0) solved.residuals.clear();
    solved.residuals.push_back(unbalanced / E + off + norms.gap + norms.complementarity);
    solved.converged = unbalanced <= tolerance * internal.norm2() && off <= tolerance && norms.gap <= tolerance &&
                       norms.complementarity <= tolerance && norms.changed == 0;
    if (solved.converged && iteration > 0) {
      solved.laws = laws;
      return solved;
    }
    last = laws.states();

    const RCP<const Graph> graph = contact.graph(at, [&] { return blocks.graph(); });
    const bool changed = A.is_null() || A->getCrsGraph() != graph;
    if (changed)
      A = rcp(new Matrix(graph));
    else
      A->resumeFill();
    A->setAllToScalar(0.0);
    blocks.assemble(*A);
    const ContactLinearisation linearised = at.linearise(laws);
    linearised.add_stiffness(*A);
    rhs.update(-1.0, internal, 0.0);  // without the forces of contact
    const NodeElimination condensed = linearised.condense(*A, rhs);
    prescribe(blocks, target, d, *A, rhs);
    A->fillComplete(blocks.dofs, blocks.dofs);

    solver.set_matrix(A, changed, {});
    condensed.solve(
        rhs, [&](const Vector& right, Vector& x) { solver.solve(right, x); }, dd, dz);
    d.update(1.0, dd, 1.0);
    z.update(1.0, dz, 1.0);
  }
  return solved;
}

}  // namespace host
