#pragma once
// Supports along directions that are not the axes of the model, together with ties.

#include <memory>
#include <vector>

#include "mortise/nonlinear/contribution.hpp"
#include "mortise/solid/prescribed_motion.hpp"

namespace mortise {

/// Ties and inclined supports as one rule for displacements. An inclined component is d_k = sum_i of_i d_i + v(t), in matrices d = T_o d + p_o. A tie
/// gives d = T_s d. Nodes that are slaves of a tie and held by supports C d = w keep what both leave them: Q = I - C^T (C C^T)^-1 C of where the
/// master has them, and what the support asks for, p_s = C^T (C C^T)^-1 w. So
///   d = Q T_s (T_o d + p_o) + p_s.
/// Forces of supports are r on nodes of T_o, with the forces of what is tied to them, and (I - Q) r on slaves.
/// Collective; without inclined components on any rank it is `ties` itself.
/// @param dofs  owned
/// @param ties  null: nothing is tied
std::shared_ptr<const TiedDisplacements> with_inclined_supports(const std::shared_ptr<const FieldSpace>& space,
                                                                const std::shared_ptr<const TiedDisplacements>& ties,
                                                                const std::shared_ptr<const PrescribedMotion>& motion);

/// Owned dofs in which inclined components hold their nodes, ascending.
std::vector<LocalOrdinal> held_dofs(const FieldSpace& space, const std::vector<InclinedComponent>& components);

}  // namespace mortise
