#include "multigrid/contact_preconditioner.hpp"

#include "multigrid/interface_correction.hpp"
#include "multigrid/sparse_parts.hpp"

namespace mortise::detail {

ContactPreconditioner make_preconditioner(const RCP<const Matrix>& A, const std::shared_ptr<const DecoupledSystem>& decoupled,
                                          const MultigridHierarchy& hierarchy) {
  if (!decoupled) return {hierarchy.cycle, Teuchos::null};
  // With the contact when the hierarchy was made: but for the tangents of the bodies C has not changed elsewhere.
  Vector now_or_then(*decoupled->contact_dofs(), Teuchos::Copy);
  now_or_then.update(1.0, *hierarchy.contact_dofs, 1.0);
  const RCP<const Map> m = marked_ids(marked_and_neighbours(*A, now_or_then, decoupled->dimension()));
  ContactPreconditioner result{hierarchy.cycle, Teuchos::null};
  if (m->getGlobalNumElements() > 0) {
    const auto rows = rcp(new RowsOfDecoupled(decoupled->rows(m)));
    const auto solution = rcp(new InterfaceSolution(rows->block(), A->getRowMap()));
    result.start = rcp(new DecoupledPreconditioner(decoupled, solution));
    result.inverse = rcp(new InterfaceCorrection(rows, solution, hierarchy.cycle));
  }
  result.inverse = rcp(new DecoupledPreconditioner(decoupled, result.inverse));
  return result;
}

}  // namespace mortise::detail
