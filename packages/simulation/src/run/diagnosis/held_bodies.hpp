#pragma once
// Pieces that diagnoses of bodies held by contact alone share.

#include <vector>

#include "mortise/simulation/model/model.hpp"
#include "mortise/simulation/model/rigid_modes.hpp"

namespace mortise {

/// mesh.bodies indices of the bodies that only contact holds. Collective.
std::vector<int> bodies_held_by_contact_only(const Model& model);

/// Where a model is at x, unknowns of its system.
NodePlaces places_at(const Model& model, const Vector& x);

}  // namespace mortise
