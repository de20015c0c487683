#pragma once
// A check that a matrix to be condensed holds what was assembled.

#include "evaluation/evaluated_contact.hpp"

namespace mortise::detail {

/// Collective. Throws std::logic_error on every rank for a matrix that was condensed and not assembled anew: the last condensed row still has its
/// values. Rows that a host replaced before cannot be told from those of a body that is prescribed there.
void refuse_condensed(const ContactModel& model, const Matrix& system);

/// Keeps a row that was condensed, for refuse_condensed(). -1: this rank condensed none.
void keep_condensed_row(const ContactModel& model, const Matrix& system, LocalOrdinal row);

}  // namespace mortise::detail
