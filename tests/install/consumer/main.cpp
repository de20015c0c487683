// An application of its own that embeds contact: two blocks that do not match, pressed, then drawn along one another with friction.

#include <Teuchos_CommHelpers.hpp>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "blocks.hpp"
#include "mortise/core/error.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"

namespace host {

constexpr double friction = 0.3, tolerance = 1e-10;

double sum_over_ranks(const Blocks& blocks, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*blocks.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

// Rows of prescribed dofs: s dd = s (prescribed - d). They are the application's, and replaced after condense().
void prescribe(const Blocks& blocks, const Vector& target, const Vector& d, Matrix& A, Vector& rhs) {
  for (LocalOrdinal row = 0; row < static_cast<LocalOrdinal>(blocks.dofs->getNodeNumElements()); ++row) {
    const GlobalOrdinal id = blocks.dofs->getGlobalElement(row);
    if (!Blocks::held(id / 2)) continue;
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
std::array<double, 2> residuals(const Blocks& blocks, const Vector& r, const Vector& target, const Vector& d) {
  double free = 0.0, off = 0.0;
  for (std::size_t row = 0; row < blocks.dofs->getNodeNumElements(); ++row)
    if (Blocks::held(blocks.dofs->getGlobalElement(static_cast<LocalOrdinal>(row)) / 2))
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
};

Solved solve_step(const Blocks& blocks, const ContactSystem& contact, const ContactHistory& accepted, const Matrix& K, LinearSolver& solver,
                  const Vector& target, Vector& d, Vector& z) {
  const ContactHistory history = contact.start_step(accepted, d, z);
  ContactStates last = history->states;
  RCP<Matrix> A;
  Solved solved{false, Vector(blocks.dofs), {}};
  Vector internal(blocks.dofs), rhs(blocks.dofs), increment(blocks.dofs), z_new(contact.multiplier_map());
  for (int iteration = 0; iteration < 30; ++iteration) {
    // A StepFailure comes on every rank: undo the step, take a smaller one.
    const DifferentiatedContact at = contact.differentiate(d, history, &last);
    const ContactLaws laws = at.laws(z);

    K.apply(d, internal);
    Tpetra::deep_copy(solved.r, internal);
    laws.add_force(solved.r);
    const ContactNorms norms = laws.norms(last);
    const auto [unbalanced, off] = residuals(blocks, solved.r, target, d);
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
    const CondensedContact condensed = linearised.condense(*A, rhs);
    prescribe(blocks, target, d, *A, rhs);
    A->fillComplete(blocks.dofs, blocks.dofs);

    solver.set_matrix(A, changed, {});
    solver.solve(rhs, increment);
    condensed.recover(increment, z_new);
    d.update(1.0, increment, 1.0);
    Tpetra::deep_copy(z, z_new);
  }
  return solved;
}

// The sum of the reactions of the lower (0) or upper (1) edge.
std::array<double, 2> reaction(const Blocks& blocks, const Vector& r, int block) {
  std::array<double, 2> mine{};
  for (std::size_t row = 0; row < blocks.dofs->getNodeNumElements(); ++row) {
    const GlobalOrdinal id = blocks.dofs->getGlobalElement(static_cast<LocalOrdinal>(row));
    if (Blocks::held(id / 2) && Blocks::block_of(id / 2) == block) mine[id % 2] += r.getData()[row];
  }
  return {sum_over_ranks(blocks, mine[0]), sum_over_ranks(blocks, mine[1])};
}

bool near(const char* what, double value, double expected, double scale) {
  const bool right = std::abs(value - expected) <= 1e-8 * scale;
  if (!right) std::printf("%s is %.15g, expected %.15g\n", what, value, expected);
  return right;
}

// Presses by `down` until time 1, then draws to the right by `right` until time 2.
int run() {
  constexpr double down = 0.02, right = 0.12, force = E * down * width / height;
  const Blocks blocks;
  const ContactSystem contact(blocks.nodes, blocks.dofs, blocks.reference, blocks.fixed, {}, {blocks.pair(friction)}, Timers());
  Matrix K(blocks.graph());
  blocks.assemble(K);
  K.fillComplete(blocks.dofs, blocks.dofs);
  LinearSolverOptions options;
  options.kind.value = LinearSolverOptions::Kind::mumps;
  const auto solver = make_linear_solver(options, blocks.comm, Timers());
  Vector d(blocks.dofs), z(contact.multiplier_map()), target(blocks.dofs);
  ContactHistory history = contact.initial_history(d);
  std::optional<ContactLaws> laws;  // at the end of the last step

  bool all_right = true;
  double time = 0.0, step = 0.25;
  while (time < 2.0) {
    for (const GlobalOrdinal id : blocks.dofs->getNodeElementList())
      if (Blocks::held(id / 2) && Blocks::block_of(id / 2) == 1)
        target.replaceGlobalValue(id, id % 2 == 0 ? right * std::max(0.0, time + step - 1.0) : -down * std::min(1.0, time + step));
    const Vector d_start(d, Teuchos::Copy), z_start(z, Teuchos::Copy);
    Solved solved{false, Vector(blocks.dofs), {}};
    try {
      solved = solve_step(blocks, contact, history, K, *solver, target, d, z);
    } catch (const StepFailure&) {
    }
    if (!solved.converged) {  // the history is still that of the last step
      Tpetra::deep_copy(d, d_start);
      Tpetra::deep_copy(z, z_start);
      step /= 2.0;
      if (step < 1e-3) throw std::runtime_error("no step converges");
      continue;
    }
    laws = solved.laws;
    history = contact.commit(*laws);
    time += step;
    const auto below = reaction(blocks, solved.r, 0), above = reaction(blocks, solved.r, 1);
    // Poisson's ratio 0: one column of height 2, whatever the meshes. Then: forces balance, and so does each body.
    if (time == 1.0) all_right &= near("the pressing force", -above[1], force, force) && near("the shear force", above[0], 0.0, force);
    const auto on_slave = resultant(*laws, 0);
    for (int i = 0; i < 2; ++i)
      all_right &= near("the sum of both reactions", below[i] + above[i], 0.0, force) &&
                   near("the contact force", std::abs(on_slave[i]), std::abs(above[i]), force);
  }
  // The upper block slides as a whole: Coulomb's law at each node that is closed.
  for (const ContactNodeState& node : node_states(*laws, 0))
    if (node.closed)
      all_right &= node.state == ContactState::slip && near("the shear traction", std::abs(node.shear), friction * node.pressure, force);
  return all_right && laws->norms(history->states).active > 0 ? 0 : 1;
}

}  // namespace host

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    return host::run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
