#pragma once
// The parameters of MueLu.

#include <Teuchos_ParameterList.hpp>
#include <vector>

#include "mortise/core/error.hpp"
#include "mortise/core/parameters.hpp"
#include "mortise/core/types.hpp"
#include "multigrid/multigrid_smoother.hpp"

namespace mortise::detail {

/// A system of equations, as far as the parameters depend on it.
struct MultigridSize {
  int equations = 1;       ///< of a node
  GlobalOrdinal rows = 0;  ///< over all ranks
  int ranks = 1;           ///< that share it
};

/// Smoothed aggregation with a smoother, and over it what is `given`. A given smoother, be it of one level, stands in place of the default one and
/// all that goes with it.
Teuchos::ParameterList multigrid_parameters(const Teuchos::ParameterList& given, Smoother smoother, const MultigridSize& size);

/// Errors of MueLu about `given`: names and types, with no matrix at hand. Collective.
std::vector<Diagnostic> multigrid_parameter_errors(const Located<Teuchos::ParameterList>& given, const RCP<const Communicator>& comm);

}  // namespace mortise::detail
