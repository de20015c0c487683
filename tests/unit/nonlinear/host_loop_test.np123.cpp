// Newton's method as docs/embedding.md shows it to hosts, where the slave reaches beyond the master.
#include <gtest/gtest.h>

#include "../../install/consumer/solve_step.hpp"
#include "mortise/contact/contact_report.hpp"
#include "mortise/core/trilinos_versions.hpp"
#include "mortise/nonlinear/linear_solver_factory.hpp"

namespace mortise {
namespace {

/// The upper block is pressed on the lower one, then also drawn along it, in equal steps.
void expect_quadratic_convergence(int dimension) {
  constexpr double down = 0.005, right = 0.01, round_off = 1e-13;
  const host::Blocks blocks(dimension, 0.28);  // a sixth of the slave's last facets is covered
  const ContactSystem contact(blocks.nodes, blocks.dofs, blocks.reference, blocks.fixed, {}, {blocks.pair(0.3)}, Timers());
  Matrix K(blocks.graph());
  blocks.assemble(K);
  K.fillComplete(blocks.dofs, blocks.dofs);
  LinearSolverOptions options;
  options.kind.value = LinearSolverOptions::Kind::mumps;
  const auto solver = make_linear_solver(options, blocks.comm, Timers());
  Vector d(blocks.dofs), z(contact.multiplier_map()), target(blocks.dofs);
  ContactHistory history = contact.initial_history(d);
  int hardly_covered = 0, sticking = 0, slipping = 0;
  for (int step = 1; step <= 4; ++step) {
    for (const GlobalOrdinal id : local_ids(*blocks.dofs))
      if (const GlobalOrdinal node = id / dimension, i = id % dimension; blocks.held(node) && blocks.block_of(node) == 1)
        target.replaceGlobalValue(id, i == 0 ? right * std::max(0, step - 2) : i == dimension - 1 ? -down * std::min(step, 2) : 0.0);
    const host::Solved solved = host::solve_step(blocks, contact, history, K, *solver, target, d, z);
    ASSERT_TRUE(solved.converged) << "step " << step;
    const std::vector<double>& residuals = solved.residuals;
    ASSERT_GE(residuals.size(), 2u);
    for (std::size_t k = 1; k < residuals.size(); ++k)
      EXPECT_LE(residuals[k], residuals[k - 1] * residuals[k - 1] + round_off) << "step " << step << ", iterate " << k;
    for (const ContactNodeState& node : node_states(*solved.laws, 0)) {
      hardly_covered += node.closed && node.covered < 0.1 * node.weight;
      sticking += node.state == ContactState::stick;
      slipping += node.state == ContactState::slip;
    }
    history = contact.commit(*solved.laws);
  }
  const auto over_ranks = [&](int mine) { return host::sum_over_ranks(blocks, mine); };
  EXPECT_GT(over_ranks(hardly_covered), 0);
  EXPECT_GT(over_ranks(sticking), 0);
  EXPECT_GT(over_ranks(slipping), 0);
}

TEST(HostLoop, ConvergesQuadraticallyInThePlane) { expect_quadratic_convergence(2); }
TEST(HostLoop, ConvergesQuadraticallyInSpace) { expect_quadratic_convergence(3); }

}  // namespace
}  // namespace mortise
