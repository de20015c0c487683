#pragma once
// An iterative solver that gives way to a direct one where factorisations take less time.

#include <memory>

#include "mortise/nonlinear/linear_solver.hpp"

namespace mortise::detail {

/// Iterations of GMRES on a system of so many unknowns that take as long as its factorisation by MUMPS. In 3D a factorisation takes about n^2
/// operations and an iteration about n, so they are in proportion to n. Measured on second-order tetrahedra (docs/solvers.md): 70 at 11 400 unknowns.
double iterations_of_factorisation(GlobalOrdinal unknowns);

/// Solves by the iterative solver. The direct solver takes the next matrices where the solves with one matrix take more than `most` iterations, or
/// one of them fails. It takes 20 matrices at first, twice as many each time that the iterative solver is found as slow again. So the time of such a
/// trial is lost among them, and contact that is over does not decide permanently. Where the direct solver has no memory the iterative one goes on.
std::unique_ptr<LinearSolver> make_automatic_solver(std::unique_ptr<LinearSolver> iterative, std::unique_ptr<LinearSolver> direct, double most);

}  // namespace mortise::detail
