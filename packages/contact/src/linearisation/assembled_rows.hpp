#pragma once
// Checks that a matrix to be condensed holds what was assembled, and no rows that were changed since.

#include "evaluation/evaluated_contact.hpp"

namespace mortise::detail {

/// Collective. Throws std::logic_error on every rank for
///   - a matrix that was condensed and not assembled anew: the last condensed row still has its values;
///   - a row of a prescribed component of a node of the surfaces that holds its diagonal alone: it was replaced before, and condensation adds to it.
void refuse_changed_rows(const ContactModel& model, const Matrix& system);

/// Keeps a row that was condensed, for refuse_changed_rows(). -1: this rank condensed none.
void keep_condensed_row(const ContactModel& model, const Matrix& system, LocalOrdinal row);

}  // namespace mortise::detail
