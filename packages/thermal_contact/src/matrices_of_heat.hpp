#pragma once
// Derivatives of the rows of heat as matrices on the host's dofs.

#include "evaluated_heat.hpp"
#include "mortise/contact/field_transfer.hpp"

namespace mortise::detail {

/// Adds the derivatives of a pass to matrices that begin as null: [dofs x dofs], [dofs x multipliers]. Takes them out of the nodes' rows. Collective.
void add_matrices(const ThermalModel& model, const FieldTransfer& transfer, EvaluatedPass& pass, RCP<const Matrix>& of_dofs,
                  RCP<const Matrix>& of_multipliers);

/// system += rows, where `system` has place for each entry.
/// @throws std::logic_error where it has none
void add_rows(const Matrix& rows, Matrix& system);

}  // namespace mortise::detail
