#pragma once
// Distance within which contact pairs look for their masters.

#include "mortise/contact/contact_pair.hpp"
#include "mortise/mesh/mesh.hpp"
#include "mortise/simulation/model/surfaces_at_start.hpp"

namespace mortise {

/// A pair with a negative clearance c acts from a distance -c on, and has to look as far. The function c is evaluated at many times of the run.
/// Collective.
void reach_for_clearances(const Mesh& mesh, const Scene& scene, SurfacesAtStart& surfaces);

/// Gives a pair the reach that it needs at the start, and for overlaps a constant of the active set.
void take_up(const PairAtStart& start, ContactPair& pair);

}  // namespace mortise
