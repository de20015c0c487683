#pragma once
// Smooth parts of a surface, bounded by its edges.

#include <vector>

#include "mortise/mesh/mesh.hpp"

namespace mortise {

/// Of each side of the set the patch that it belongs to: the least number of a side in it, 8 x the element's id + 1 + the side. Two sides that share
/// an edge, in 2D a node, are in one patch if their normals there differ by at most `angle` degrees. The same on any number of ranks. Collective.
std::vector<GlobalOrdinal> patches_of(const Mesh& mesh, const SideSet& set, double angle);

/// The number of a side; that of a patch is the least of its sides.
GlobalOrdinal side_number(const Mesh& mesh, const Side& side);

/// The mean of a side's nodes.
std::array<double, 3> middle_of(const Mesh& mesh, const Side& side);

/// Outward normal by the corners, as long as the side, in 3D as its area.
std::array<double, 3> normal_of(const Mesh& mesh, const Side& side);

}  // namespace mortise
