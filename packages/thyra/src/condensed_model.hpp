#pragma once
// The decorator that keeps the application's unknowns.

#include <memory>

#include "step_memory.hpp"

namespace mortise::detail {

/// f is the residual of the condensed system, W its matrix. At an iterate (d, z) Newton's method asks for
///   K~ dd + B dz = -(r + B z),   C_d dd + C_z dz = -C,
/// and condensation makes A dd = -f of that, see NodeElimination. f has the conditions in rows of closed slave nodes, in units of forces, and
/// momentum elsewhere. It vanishes where the multipliers that momentum gives meet all conditions. A solve with W gives Newton's step dd exactly, with
/// the couplings that A leaves out where nodes are hardly covered. W as an operator is A.
RCP<ModelWithContact> condensed_model(const RCP<ThyraModel>& model, const std::shared_ptr<StepMemory>& memory,
                                      const RCP<const ThyraSolverFactory>& solver);

}  // namespace mortise::detail
