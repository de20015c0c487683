#pragma once
// Supports and ties of a scene as constraints of its unknowns.

#include <functional>
#include <memory>
#include <vector>

#include "mortise/mesh/field_space.hpp"
#include "mortise/mortar/tied_surfaces.hpp"
#include "mortise/nonlinear/affine_constraints.hpp"
#include "mortise/solid/prescribed_motion.hpp"

namespace mortise {

/// Constraints, and what supports bear.
struct SupportConstraints {
  std::shared_ptr<const AffineConstraints> lines;
  std::function<void(const Vector& forces, Vector& gathered)> put_support_forces;  ///< SystemParts::put_support_forces; empty: nothing is inclined
};

/// Constraints of other fields than the displacement; shares count from 0 in their values.
struct FurtherConstraints {
  std::vector<AffineConstraints::Line> lines;
  AffineConstraints::Values values;   ///< empty: there are none
};

/// Prescribed components are lines without terms, inclined ones d_k = sum_i of_i d_i + v(t), those of a tie d_s = sum_m P_sm d_m. Nodes that are
/// slaves of a tie and held by supports C d = w keep what both leave them: Q = I - C^T (C C^T)^-1 C of where the master has them, and what the
/// support asks for,
///   d_s = Q P d_m + C^T (C C^T)^-1 w.
/// Forces of supports are r on nodes that are no slaves, with the forces of what is tied to them, and (I - Q) r on slaves. Collective.
/// @param ties     null: nothing is tied
/// @param further  joins them
SupportConstraints support_constraints(const std::shared_ptr<const FieldSpace>& space, const std::shared_ptr<const TieRows>& ties,
                                       const std::shared_ptr<const PrescribedMotion>& motion, const FurtherConstraints& further);

/// Owned dofs in which inclined components hold their nodes, ascending.
std::vector<LocalOrdinal> held_dofs(const FieldSpace& space, const std::vector<InclinedComponent>& components);

}  // namespace mortise
