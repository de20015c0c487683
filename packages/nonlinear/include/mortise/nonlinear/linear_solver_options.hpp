#pragma once
// Options of linear solvers.

#include <Teuchos_ParameterList.hpp>

#include "mortise/core/error.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/core/types.hpp"

namespace mortise {

/// Which solver, and its settings. `automatic` is the iterative solver in 3D from `fewest_for_multigrid` unknowns on if it can solve the systems.
/// Else it is MUMPS.
struct LinearSolverOptions {
  /// Which solver.
  enum class Kind { automatic, mumps, klu2, iterative };
  /// From here on it takes less time than a factorisation, and much less memory (docs/results/space.md).
  static constexpr GlobalOrdinal fewest_for_multigrid = 10000;
  Located<Kind> kind{Kind::automatic, {}};  ///< which one
  double residual_bound = 1e-8;             ///< of the direct solvers' backward error |b - A x| / (|A| |x| + |b|)
  double tolerance = 1e-10;                 ///< of the iterative solver
  double largest_tolerance = 1e-3;          ///< of the iterative solver, while Newton's iterate is far from the solution
  int maximum_iterations = 500;             ///< of the iterative solver
  Located<Teuchos::ParameterList> muelu;    ///< overrides what Mortise sets; checked by MueLu
  Located<Teuchos::ParameterList> belos;    ///< likewise, by Belos
  void describe(Parameters& parameters);    ///< the list "linear solver"
};

}  // namespace mortise
