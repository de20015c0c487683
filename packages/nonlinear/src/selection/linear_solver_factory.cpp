#include "mortise/nonlinear/linear_solver_factory.hpp"

#include "linear/direct_solver.hpp"
#include "multigrid/iterative_solver.hpp"
#include "selection/automatic_solver.hpp"

namespace mortise {

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, const RCP<const Communicator>& comm, const Timers& timers,
                                                 const LinearSystemTraits& traits) {
  using Kind = LinearSolverOptions::Kind;
  switch (options.kind.value) {
    case Kind::klu2:
      if (comm->getSize() > 1)
        throw InputError(options.kind.place,
                         "klu2 runs on one rank only: on more, this Trilinos' KLU2 returns wrong solutions without an error; use mumps");
      return detail::make_klu2_solver(options, timers);
    case Kind::iterative:
      if (!traits.not_iterative.empty()) throw InputError(options.kind.place, traits.not_iterative);
      return detail::make_iterative_solver(options, comm, timers, "");
    case Kind::automatic:
      if (traits.dimension == 3 && traits.unknowns >= LinearSolverOptions::fewest_for_multigrid && traits.not_iterative.empty()) {
        auto iterative = detail::make_iterative_solver(options, comm, timers, "automatic: ");
        const double most = detail::iterations_of_factorisation(traits.unknowns);
        if (most >= options.maximum_iterations) return iterative;
        return detail::make_automatic_solver(std::move(iterative), detail::make_mumps_solver(options, timers, "automatic: MUMPS"), most);
      }
      return detail::make_mumps_solver(options, timers, "automatic: MUMPS");
    case Kind::mumps:
      break;
  }
  return detail::make_mumps_solver(options, timers, "MUMPS");
}

}  // namespace mortise
