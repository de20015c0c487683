#pragma once
// The linear solver that options ask for.

#include <memory>
#include <string>

#include "mortise/core/timers.hpp"
#include "mortise/core/types.hpp"
#include "mortise/nonlinear/linear_solver.hpp"
#include "mortise/nonlinear/linear_solver_options.hpp"

namespace mortise {

/// What is known of the systems to be solved before there is one.
struct LinearSystemTraits {
  GlobalOrdinal unknowns = 0;  ///< over all ranks
  int dimension = 2;           ///< of the model: 2 or 3
  std::string not_iterative;   ///< why the iterative solver cannot solve them, a sentence; empty: it can
};

/// Makes the solver that `options` ask for.
/// @throws InputError where that cannot work: KLU2 on more than one rank, systems that the iterative solver cannot solve, a parameter that MueLu or
/// Belos does not know
std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, const RCP<const Communicator>& comm, const Timers& timers,
                                                 const LinearSystemTraits& traits = {});

}  // namespace mortise
