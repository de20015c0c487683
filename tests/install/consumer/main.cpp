// An application of its own that embeds contact: two blocks that do not match, pressed, then drawn along one another with friction.

#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "mortise/core/error.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "solve_step.hpp"

namespace host {

constexpr double friction = 0.3;

// The sum of the reactions of the lower (0) or upper (1) face.
std::array<double, 3> reaction(const Blocks& blocks, const Vector& r, int block) {
  std::array<double, 3> mine{};
  for (std::size_t row = 0; row < local_id_count(*blocks.dofs); ++row) {
    const GlobalOrdinal id = blocks.dofs->getGlobalElement(static_cast<LocalOrdinal>(row));
    const GlobalOrdinal node = id / blocks.dimension;
    if (blocks.held(node) && blocks.block_of(node) == block) mine[id % blocks.dimension] += r.getData()[row];
  }
  for (double& sum : mine) sum = sum_over_ranks(blocks, sum);
  return mine;
}

bool near(const char* what, double value, double expected, double scale) {
  const bool right = std::abs(value - expected) <= 1e-8 * scale;
  if (!right) std::printf("%s is %.15g, expected %.15g\n", what, value, expected);
  return right;
}

// Presses by `down` until time 1, then draws to the right by `right` until time 2.
bool run(int dimension) {
  constexpr double down = 0.02, right = 0.12, force = E * down * width / height;
  const Blocks blocks(dimension);
  const int up = dimension - 1;
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
    for (const GlobalOrdinal id : local_ids(*blocks.dofs))
      if (const GlobalOrdinal node = id / dimension, i = id % dimension; blocks.held(node) && blocks.block_of(node) == 1)
        target.replaceGlobalValue(id, i == 0 ? right * std::max(0.0, time + step - 1.0) : i == up ? -down * std::min(1.0, time + step) : 0.0);
    const Vector d_start(d, Teuchos::Copy), z_start(z, Teuchos::Copy);
    Solved solved{false, Vector(blocks.dofs), {}, {}};
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
    // Poisson's ratio 0: one column of height 2 and section 1, whatever the meshes. Then: forces balance, and so does each body.
    if (time == 1.0) all_right &= near("the pressing force", -above[up], force, force) && near("the shear force", above[0], 0.0, force);
    const auto on_slave = resultant(*laws, 0);
    for (int i = 0; i < dimension; ++i)
      all_right &= near("the sum of both reactions", below[i] + above[i], 0.0, force) &&
                   near("the contact force", std::abs(on_slave[i]), std::abs(above[i]), force);
  }
  // The upper block slides as a whole: Coulomb's law at each node that is closed.
  for (const ContactNodeState& node : node_states(*laws, 0))
    if (node.closed)
      all_right &= node.state == ContactState::slip && near("the shear traction", std::abs(node.shear), friction * node.pressure, force);
  return all_right && laws->norms(history->states).active > 0;
}

}  // namespace host

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    const bool in_plane = host::run(2), in_space = host::run(3);
    return in_plane && in_space ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
