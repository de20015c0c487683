#include "mortise/nonlinear/linear_solver.hpp"

#include "automatic_solver.hpp"
#include "direct_solver.hpp"
#include "iterative_solver.hpp"

namespace mortise {

void LinearSolverOptions::describe(Parameters& parameters) {
  parameters.add("type", kind, {{"automatic", Kind::automatic}, {"mumps", Kind::mumps}, {"klu2", Kind::klu2}, {"iterative", Kind::iterative}},
                 "automatic: iterative in 3D from 10000 unknowns on, and mumps where that is slow, otherwise mumps; mumps: direct, on any number of ranks; "
                 "klu2: direct, on one rank; iterative: GMRES with algebraic multigrid");
  parameters.add(
      "residual bound", residual_bound,
      Says("largest backward error |b - A x| / (|A| |x| + |b|) of a direct solver after refinement, which is tried where |b - A x| / |b| is "
           "larger than this; beyond it the step is undone")
          .unit("-")
          .above(0.0));
  parameters.add("tolerance", tolerance, Says("smallest relative residual to which the iterative solver goes").unit("-").above(0.0).below(1.0));
  parameters.add("largest tolerance", largest_tolerance,
                 Says("relative residual at which the iterative solver stops while Newton's iterate is far from the solution. From there it falls "
                      "with the square of Newton's residual. Not above \"tolerance\": every solve goes to \"tolerance\"")
                     .unit("-")
                     .above(0.0)
                     .below(1.0));
  parameters.add("maximum iterations", maximum_iterations, Says("of the iterative solver; beyond them the step is undone").at_least(1));
  parameters.verbatim("muelu", muelu, "parameters of MueLu that replace or add to those Mortise sets");
  parameters.verbatim("belos", belos, "parameters of Belos that replace or add to those Mortise sets");
}

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
