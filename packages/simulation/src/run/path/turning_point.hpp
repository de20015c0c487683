#pragma once
// Loads and motions at which the path of equilibria turns back.

#include <string>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Explains a failed step by a maximum of the load or the prescribed motion next to the last accepted state. Then the step that failed has no
/// equilibrium, as where a structure snaps through (loads) or back (motions). The path of equilibria is followed past the maximum on planes across it
/// (Riks 1979). Collective.
/// @returns in words for people, with the share of each body's volume that flows; empty if the path does not turn back there, or is not found
std::string explain_turning_point(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system);

}  // namespace mortise
