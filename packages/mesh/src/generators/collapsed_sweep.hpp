#pragma once
// Swept bodies whose profile reaches the axis: there cells have fewer nodes.

#include "mortise/mesh/mesh_file.hpp"
#include "mortise/mesh/shell_complex.hpp"
#include "mortise/mesh/swept_complex.hpp"

namespace mortise {

/// The body of a profile that is turned about the y axis and reaches it. Nodes on the axis are one for all layers. So hexahedra with an edge there
/// are wedges, wedges with a node or an edge there pyramids or tetrahedra, and tetrahedra that have no volume are left out.
/// @throws InputError at `place` where a cell meets the axis as no element of its order does
MeshFile collapse_onto_axis(const SweptComplex& complex, const Place& place);

/// The surface of a rigid body whose profile reaches the axis. Quadrilaterals with an edge there are triangles. Sides of the profile are sets of
/// cells.
/// @param unplaced  before its placement, where the axis is y; nodes no further from it than `near` are on it
/// @param placed    the same surface
MeshFile collapse_onto_axis(const ShellComplex& unplaced, const ShellComplex& placed, double near);

}  // namespace mortise
