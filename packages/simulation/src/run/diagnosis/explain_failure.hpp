#pragma once
// Explanation of a step that failed: bodies that nothing holds any more.

#include <string>

#include "mortise/nonlinear/load_stepper.hpp"
#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/run/diagnosis/contact_hold.hpp"

namespace mortise {

/// Rigid motions of bodies that only contact holds, singly or together, which J hardly resists where a failed try was linearised last. They are the
/// vectors of A^T A with the smallest values. Here A = J R / (s |R|), with the rigid body modes R of these bodies and the stiffness scale s. A
/// reference point that turns in 3D is taken to have turned by a small angle: free rotations of one that has turned far are not found. Collective.
/// @param record  what pairs did in accepted states
/// @returns in words for people; empty if there is nothing to say
std::string explain_failure(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system, const ContactRecord& record);

/// State of contact at the bodies that it alone holds, where a failed try was linearised last: reported where no reason is known. Collective.
/// @returns in words for people; empty if there are no such bodies
std::string describe_held_bodies(const FailedTry& failed, const Model& model, const SemiSmoothSystem& system, const ContactRecord& record);

}  // namespace mortise
