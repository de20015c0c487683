#pragma once
// GMRES of Belos, preconditioned by smoothed aggregation of MueLu.

#include <memory>

#include "mortise/core/timers.hpp"
#include "mortise/nonlinear/linear_solver.hpp"
#include "mortise/nonlinear/linear_solver_options.hpp"

namespace mortise::detail {

/// @throws InputError for parameters that MueLu or Belos does not know
std::unique_ptr<LinearSolver> make_iterative_solver(const LinearSolverOptions& options, const RCP<const Communicator>& comm, const Timers& timers,
                                                    const std::string& chosen);

}  // namespace mortise::detail
