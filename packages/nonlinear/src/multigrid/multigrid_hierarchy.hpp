#pragma once
// A multigrid hierarchy: of a matrix, or of what is left of a condensed contact system.

#include "mortise/nonlinear/linear_solver.hpp"
#include "multigrid/decoupled_multigrid.hpp"
#include "multigrid/multigrid_smoother.hpp"

namespace mortise::detail {

/// Data that multigrid keeps of the matrix that it was set up for.
struct MultigridHierarchy {
  RCP<const Operator> cycle;       ///< applies one cycle
  RCP<const Vector> contact_dofs;  ///< DecoupledSystem::contact_dofs() of that matrix; null: without contact
};

/// Sets up multigrid for A or, if `decoupled` is not null, for its matrix C. Collective.
/// @param given    parameters of MueLu
/// @param weakest  without coordinates: |a_ij| over the geometric mean of the diagonals below which aggregates do not reach from i to j
MultigridHierarchy make_hierarchy(const RCP<const Matrix>& A, const DecoupledSystem* decoupled, const NearNullSpace& near_null_space,
                                  const Teuchos::ParameterList& given, Smoother smoother, double weakest = 0.0);

}  // namespace mortise::detail
