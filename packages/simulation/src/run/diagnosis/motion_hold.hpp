#pragma once
// Free motions without a load along them are held numerically.

#include <optional>

#include "mortise/nonlinear/held_motions.hpp"
#include "run/diagnosis/free_bodies.hpp"

namespace mortise {

/// SystemParts::held_motions: of the bodies that contact alone holds, the motions at an iterate that neither boundary conditions nor closed nodes
/// hold and no load acts along. Where a load does act along a motion of a group of bodies, the motions across it count. Nothing if there are none, or
/// no dofs to hold them at. Collective.
std::optional<HeldMotions> motions_without_load(const Model& model, const SystemEvaluation& at, const std::vector<int>& bodies,
                                                double momentum_tolerance);

}  // namespace mortise
