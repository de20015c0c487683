#pragma once
// The decorator whose unknowns are displacements and multipliers.

#include <memory>

#include "step_memory.hpp"

namespace mortise::detail {

/// x = (x of the application, z). f = (r + f_c, A_j C): momentum, and the conditions as forces. W has all four blocks. A solve with it condenses, if
/// the formulation allows that, else the application's solver gets one matrix with multipliers among its unknowns.
RCP<ModelWithContact> product_model(const RCP<ThyraModel>& model, const std::shared_ptr<StepMemory>& memory,
                                    const RCP<const ThyraSolverFactory>& solver);

}  // namespace mortise::detail
