#include "mortise/nonlinear/linear_solver_options.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mortise {

void LinearSolverOptions::describe(Parameters& parameters) {
  // With its type: in C++20 the pairs could be of Located<Kind> too.
  const std::vector<std::pair<std::string, Kind>> kinds = {
      {"automatic", Kind::automatic}, {"mumps", Kind::mumps}, {"klu2", Kind::klu2}, {"iterative", Kind::iterative}};
  parameters.add(
      "type", kind, kinds,
      "automatic: iterative in 3D from 10000 unknowns on, and mumps where that is slow, otherwise mumps; mumps: direct, on any number of ranks; "
      "klu2: direct, on one rank; iterative: GMRES with algebraic multigrid");
  parameters.add(
      "residual bound", residual_bound,
      Says("largest backward error |b - A x| / (|A| |x| + |b|) of a direct solver after refinement, which is tried where |b - A x| / |b| is "
           "larger than this; beyond it the step is undone")
          .unit("-")
          .above(0.0));
  parameters.add("tolerance", tolerance, Says("relative residual to which the iterative solver goes at most").unit("-").above(0.0).below(1.0));
  parameters.add(
      "largest tolerance", largest_tolerance,
      Says("relative residual at which the iterative solver stops while Newton's iterate is far from the solution; from there it falls with the "
           "square of Newton's residual; not above \"tolerance\": every solve goes to \"tolerance\"")
          .unit("-")
          .above(0.0)
          .below(1.0));
  parameters.add("maximum iterations", maximum_iterations, Says("of the iterative solver; beyond them the step is undone").at_least(1));
  parameters.verbatim("muelu", muelu, "parameters of MueLu that replace or add to those Mortise sets");
  parameters.verbatim("belos", belos, "parameters of Belos that replace or add to those Mortise sets");
}

}  // namespace mortise
