#pragma once
// Equilibrium of bodies that contact alone holds: by statics, without Newton's method.

#include <string>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

enum class StaticsVerdict {
  unknown,   ///< there is nothing to say
  falls,     ///< no contact forces bear the load
  marginal,  ///< bearing or not is below round-off
  held       ///< contact forces bear the load, and would bear any other a little beside it
};

struct StaticsReason {
  StaticsVerdict verdict = StaticsVerdict::unknown;
  std::string words;  ///< for people; empty if unknown
};

/// Compares the loads at the time of a try with the forces that contact can bear in the accepted state `x` that it starts from. Each node that is
/// closed there or about to close bears a pressure >= 0 along its normal and a shear of at most mu times as much. Bodies that rest on one another are
/// looked at together. A body that falls slides, tips over, is lifted off or is not held along its surface. The motion on which no such forces work
/// against the load tells which. Laws of friction that are no cone count for rough without bound: then a body that falls does so whatever they say.
/// Collective.
/// @param context  of the try
StaticsReason explain_statics(const Model& model, const SemiSmoothSystem& system, const Vector& x, const StepContext& context);

}  // namespace mortise
