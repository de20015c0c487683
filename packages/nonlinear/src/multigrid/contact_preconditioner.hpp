#pragma once
// Preconditioner of GMRES: a multigrid cycle, and around it what the present contact asks for.

#include <memory>

#include "multigrid/multigrid_hierarchy.hpp"

namespace mortise::detail {

/// Operators for the solves with one matrix.
struct ContactPreconditioner {
  RCP<const Operator> inverse;  ///< approximately that of the matrix
  RCP<const Operator> start;    ///< the nodes in contact alone, solved for: where a solve starts; null: at 0
};

/// Decouples contact and corrects the cycle with the matrix and the states of its nodes as they are, whatever matrix the hierarchy was made for.
/// Collective.
/// @param decoupled  of A; null: no contact
ContactPreconditioner make_preconditioner(const RCP<const Matrix>& A, const std::shared_ptr<const DecoupledSystem>& decoupled,
                                          const MultigridHierarchy& hierarchy);

}  // namespace mortise::detail
