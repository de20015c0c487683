#pragma once
// Fields of one unknown at a node that contact couples strongly.

#include "mortise/contact/decoupling.hpp"
#include "multigrid/fields/field_blocks.hpp"

namespace mortise::detail {

/// Surfaces that conduct well join the temperatures of both sides: the row of a slave node j is beta_j (theta_j - sum_l m_jl theta_l) + ..., l the
/// nodes of the master. Where beta_j is more than half of its diagonal, the jump becomes an unknown of its own, as gaps do:
///   S_jl = m_jl,   L = S^T,   N_j = 1.
/// -beta_j m_jl are the entries of the matrix, of either sign with dual functions. Elsewhere the coupling is no stronger than that of the bodies, and
/// nothing changes. Collective.
/// @param A         the field's diagonal block
/// @param field     its part
/// @param first     that of displacements
/// @param of_first  their decoupling, which says what the nodes of the master are
Decoupling scalar_decoupling(const Matrix& A, const FieldPart& field, const FieldPart& first, const Decoupling& of_first);

}  // namespace mortise::detail
