#pragma once
// Checks of a pair's options that a host set by code: their ranges, and that all ranks have the same.

#include <string>
#include <vector>

#include "mortise/contact/contact_pair.hpp"
#include "mortise/core/types.hpp"

namespace mortise::detail {

/// Collective. Throws InputError for
///   - numbers of pairs, names, Young's moduli or options that differ between ranks;
///   - options beyond the range that their `describe` says, and what is not a number;
///   - a second pass of no earlier pair, or of one whose formulation has none.
/// Formulations and laws of friction must not be null.
void refuse_wrong_options(const Communicator& comm, std::vector<ContactPair>& pairs);

}  // namespace mortise::detail
