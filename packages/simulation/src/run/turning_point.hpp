#pragma once
// Loads and motions at which the path of equilibria turns back.

#include <string>

#include "mortise/nonlinear/semi_smooth_system.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Whether the load or the prescribed motion has a maximum next to the last converged state. Then the step from that state to `to` has no
/// equilibrium, as where a structure snaps through (loads) or back (motions). The path of equilibria is followed past the maximum on planes across it
/// (Riks 1979). Collective. Leaves system.time() at `to`, linearised at `failed`.
/// @param converged  x of the last converged state, at pseudo-time `from`
/// @param failed     x where the try that failed was linearised last
/// @returns in words for people, with the share of each body's volume that flows; empty if the path does not turn back there, or is not found
std::string explain_turning_point(const Model& model, SemiSmoothSystem& system, const Vector& converged, const Vector& failed, double from,
                                  double to);

}  // namespace mortise
