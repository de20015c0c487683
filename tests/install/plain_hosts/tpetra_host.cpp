// What hosts without Trilinos are compared with: the blocks of ../consumer, pressed, then drawn aside with friction. Prints d and z.
//   tpetra_host DIMENSION

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "../consumer/solve_step.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"

namespace host {

constexpr double down = 0.02, right = 0.12;

int run(int dimension) {
  const Blocks blocks(dimension);
  const ContactSystem contact(blocks.nodes, blocks.dofs, blocks.reference, blocks.fixed, {}, {blocks.pair(0.3)}, Timers());
  Matrix K(blocks.graph());
  blocks.assemble(K);
  K.fillComplete(blocks.dofs, blocks.dofs);
  LinearSolverOptions options;
  options.kind.value = LinearSolverOptions::Kind::mumps;
  const auto solver = make_linear_solver(options, blocks.comm, Timers());
  Vector d(blocks.dofs), z(contact.multiplier_map()), target(blocks.dofs);
  ContactHistory history = contact.initial_history(d);
  for (int step = 1; step <= 8; ++step) {
    const double time = 0.25 * step;
    for (const GlobalOrdinal id : mortise::local_ids(*blocks.dofs))
      if (const GlobalOrdinal node = id / dimension, i = id % dimension; blocks.held(node) && blocks.block_of(node) == 1)
        target.replaceGlobalValue(id, i == 0 ? right * std::max(0.0, time - 1.0) : i == dimension - 1 ? -down * std::min(1.0, time) : 0.0);
    const Solved solved = solve_step(blocks, contact, history, K, *solver, target, d, z);
    if (!solved.converged) return 1;
    history = contact.commit(*solved.laws);
  }
  for (std::size_t k = 0; k < mortise::local_id_count(*blocks.dofs); ++k)
    std::printf("d %lld %.17g\n", blocks.dofs->getGlobalElement(static_cast<LocalOrdinal>(k)), d.getData()[k]);
  const GlobalOrdinal first = blocks.dofs->getMaxAllGlobalIndex() + 1;
  for (std::size_t k = 0; k < mortise::local_id_count(*contact.multiplier_map()); ++k)
    std::printf("z %lld %.17g\n", contact.multiplier_map()->getGlobalElement(static_cast<LocalOrdinal>(k)) - first, z.getData()[k]);
  return 0;
}

}  // namespace host

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    return host::run(std::atoi(argv[1]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
