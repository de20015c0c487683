// The whole way to contact, as docs/embedding.md shows it: a block pressed onto another one that it does not match, with friction.

#include <Tpetra_Core.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "mortise/nonlinear/linear_solver_factory.hpp"
#include "solve_step.hpp"

using namespace host;

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  const Blocks blocks(3);  // the application's own: maps, elements, assembly
  Matrix K(blocks.graph());
  blocks.assemble(K);
  K.fillComplete(blocks.dofs, blocks.dofs);

  const auto coulomb = std::make_shared<CoulombFriction>();
  coulomb->coefficient = ScalarFunction(0.3);
  ContactPair pair;
  pair.name = "joint";
  pair.slave = blocks.face(1);
  pair.master = blocks.face(0);
  pair.youngs_modulus = E;
  pair.options.friction = {"coulomb", coulomb, {}};
  const ContactSystem contact(blocks.nodes, blocks.dofs, blocks.reference, blocks.fixed, {}, {pair}, Timers());
  const auto solver = make_linear_solver(LinearSolverOptions(), blocks.comm, Timers());

  Vector d(blocks.dofs), z(contact.multiplier_map()), dd(blocks.dofs), dz(contact.multiplier_map()), r(blocks.dofs), rhs(blocks.dofs);
  ContactHistory accepted = contact.initial_history(d);
  double force = 0.0;
  for (const double down : {0.005, 0.010, 0.015, 0.020}) {
    const ContactHistory history = contact.start_step(accepted, d, z);
    ContactStates last = history->states;
    const Vector target = blocks.pressed(down);
    for (int iteration = 0;; ++iteration) {
      if (iteration == 20) throw std::runtime_error("Newton's method does not converge: take a smaller step from `accepted`");
      const DifferentiatedContact at = contact.differentiate(d, history, &last);
      const ContactLaws laws = at.laws(z);
      K.apply(d, r);
      rhs.update(-1.0, r, 0.0);
      laws.add_force(r);  // r = f_int(d) + f_c(d, z)
      const ContactNorms norms = laws.norms(last);
      const auto [unbalanced, off] = residuals(blocks, r, target, d);
      if (unbalanced < 1e-10 * E && off < 1e-10 && norms.gap < 1e-10 && norms.complementarity < 1e-10 && norms.changed == 0) {
        accepted = contact.commit(laws);
        force = resultant(laws, 0)[2];
        break;
      }
      last = laws.states();
      Matrix A(contact.graph(at, [&] { return blocks.graph(); }));
      blocks.assemble(A);
      const ContactLinearisation linearised = at.linearise(laws);
      linearised.add_stiffness(A);
      const NodeElimination condensed = linearised.condense(A, rhs);
      prescribe(blocks, target, d, A, rhs);  // rows of prescribed dofs, in A and in rhs
      A.fillComplete(blocks.dofs, blocks.dofs);
      solver->set_matrix(Teuchos::rcpFromRef(A), true, {});
      condensed.solve(
          rhs, [&](const Vector& right, Vector& x) { solver->solve(right, x); }, dd, dz);
      d.update(1.0, dd, 1.0);
      z.update(1.0, dz, 1.0);
    }
  }
  std::printf("the upper block is pressed with %.6f\n", force);
  return std::abs(force - E * 0.020 / height) < 1e-8 * E ? 0 : 1;
}
