#pragma once
// Smoother of a multigrid cycle, and those that are tried where it fails.

#include <Teuchos_ParameterList.hpp>
#include <optional>

namespace mortise::detail {

/// A smoother on all levels. With Chebyshev polynomials an iteration takes half of the time that it takes with Gauss-Seidel sweeps, which a processor
/// cannot stream, but they want eigenvalues that are nearly real. `given` is what parameters of MueLu ask for.
enum class Smoother { chebyshev, gauss_seidel, given };

/// The smoother of the first solve: Chebyshev polynomials, unless `parameters` of MueLu give one, of one level at least. Parameters of a level's
/// smoother alone are those of the default one.
Smoother first_smoother(const Teuchos::ParameterList& parameters);

/// The smoother to try, for good, where a solve with this one failed; none: the solve has failed.
std::optional<Smoother> next_smoother(Smoother smoother);

/// Iterations after which a solve with this smoother has failed. Infinite if there is no next one.
double most_iterations(Smoother smoother);

/// Sets a smoother in `parameters` of MueLu, with the cycle and the aggregates that go with it.
void set_smoother(Teuchos::ParameterList& parameters, Smoother smoother, int levels, int ranks);

}  // namespace mortise::detail
