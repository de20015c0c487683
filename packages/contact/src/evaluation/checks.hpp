#pragma once
// Checks of the arguments of ContactSystem, refused at once where nothing right could come of them.

#include <stdexcept>
#include <string>
#include <vector>

#include "mortise/contact/contact_pair.hpp"
#include "mortise/core/nodal_field.hpp"
#include "mortise/core/types.hpp"

namespace mortise::detail {

/// An argument that must not be null.
template <class T>
const RCP<T>& given(const RCP<T>& argument, const char* name) {
  if (argument.is_null()) throw std::invalid_argument(std::string("contact: `") + name + "` is null");
  return argument;
}

/// Collective. Throws std::invalid_argument for arguments that do not fit together. Such are
///   - a field with ids that are not among the dofs, or with one row twice;
///   - components that are neither unknown nor prescribed;
///   - positions that are not finite, other marks than those of prescribed components, and either of them on other nodes.
void refuse_unfit_fields(const NodalField& displacement, const Map& dofs, const MultiVector& reference, const MultiVector& fixed);
/// Collective. Throws std::invalid_argument for a further field on other nodes, or with ids that are not among the dofs.
void refuse_unfit_field(const NodalField& field, const Map& owned_nodes, const Map& dofs);

/// Collective. Throws InputError for a pair without Young's modulus, formulation or law of friction, with negative ids, or with other than one of
/// `facet_gaps` for each owned node.
void refuse_incomplete_pairs(const Map& owned_nodes, const std::vector<ContactPair>& pairs);

}  // namespace mortise::detail
