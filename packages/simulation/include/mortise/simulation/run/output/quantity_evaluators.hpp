#pragma once
// The quantities of a scene in one run.

#include <memory>
#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/quantities/quantity.hpp"

namespace mortise {

/// Of all quantities of a scene, in their order.
using QuantityEvaluators = std::vector<std::unique_ptr<QuantityEvaluator>>;

/// Context of quantities before anything is solved.
QuantityContext quantity_context(const Scene& scene, const Model& model);

/// Collective. Throws InputError, on all ranks, for sets, bodies and pairs that do not exist.
QuantityEvaluators make_evaluators(const Scene& scene, const Model& model);

}  // namespace mortise
