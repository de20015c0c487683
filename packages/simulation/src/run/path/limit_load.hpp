#pragma once
// Loads beyond which there is no equilibrium.

#include <string>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"

namespace mortise {

/// Momentum over forces from which on the step adds a load: what a converged state leaves is below.
constexpr double least_load = 1e-7;

/// Explains that a step failed because its load is more than the bodies can bear. The displacement u is the answer of the stiffness K at the failed
/// try's last linearisation to the load that the step adds. K_e is the stiffness at the last converged state, where points that have flowed answer
/// elastically. Along a mechanism of plastic flow u^T K u is nothing beside u^T K_e u. Beyond a limit point it is negative (Bergan et al. 1978: the
/// current stiffness parameter). Asked only where Newton's method came to no end close to equilibrium, and where the step adds a load: prescribed
/// displacements pass such a point. Collective.
/// @returns in words for people, with the share of each body's volume that flows; empty if the failure has another cause
std::string explain_limit_load(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system);

/// "plastic flow in 91 % of body 'bar'", the share of each body's volume that flows between two displacements; or that none does, and what it means
/// beyond a limit. Collective.
std::string describe_flow(const Model& model, const Vector& failed, const Vector& converged);

}  // namespace mortise
